#include "core/drawing/svg_text.hpp"

#include <algorithm>
#include <numbers>

#include "core/drawing/svg_frame.hpp"
#include "core/text/malformed.hpp"
#include "core/text/utf8.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_letters = 100000;

FontRequest request(const FontStyle& font) {
  return {font.families, font.weight, font.italic};
}

bool is_white_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The entry for the letter `index` of an element, if its list is long enough.
std::optional<double> entry(const std::vector<double>& list, std::size_t index) {
  if (index >= list.size()) return std::nullopt;
  return list[index];
}

}  // namespace

void Scene::text(const pugi::xml_node& node, const Entered& entered) {
  SvgText(*this, node, entered).paint();
}

SvgText::SvgText(Scene& scene, const pugi::xml_node& node, const Entered& entered)
    : scene_(scene), node_(node), entered_(entered) {}

void SvgText::paint() {
  collect(node_, entered_, 0);
  if (!letters_.empty() && letters_.back().bytes == " " &&
      !run_at_[letters_.back().run]->entered.style.font.keep_spaces)
    letters_.pop_back();
  lay_out();
  for (std::size_t i = 0; i < placed_.size();) {
    const std::size_t run = placed_[i].run;
    std::size_t end = i;
    while (end < placed_.size() && placed_[end].run == run) ++end;
    const Run& of = *run_at_[run];
    const double size = of.entered.style.font.size;
    scene_.paint(of.node, of.entered, [&](Outline& outline) {
      for (std::size_t k = i; k < end; ++k) {
        const Placed& placed = placed_[k];
        const Eigen::Affine2d place = Eigen::Translation2d(placed.at) * Eigen::Rotation2Dd(placed.turn) *
                                      Eigen::Scaling(size, -size) * Eigen::Translation2d(placed.glyph.offset);
        scene_.fonts_.draw(placed.glyph, place, outline);
      }
    });
    i = end;
  }
}

double SvgText::base_of(const Style& style) {
  using Baseline = FontStyle::Baseline;
  if (style.font.baseline == Baseline::alphabetic) return 0;
  const FontHeights heights = scene_.fonts_.heights(request(style.font));
  double up = 0;
  if (style.font.baseline == Baseline::middle) up = heights.x_height / 2;
  if (style.font.baseline == Baseline::central) up = (heights.ascent + heights.descent) / 2;
  if (style.font.baseline == Baseline::hanging) up = heights.ascent;
  if (style.font.baseline == Baseline::bottom) up = heights.descent;
  return -up * style.font.size;
}

std::vector<double> SvgText::lengths(const pugi::xml_node& node, const Entered& entered, const char* name,
                                     double whole) {
  std::vector<double> result;
  std::string list = node.attribute(name).value();
  std::replace(list.begin(), list.end(), ',', ' ');
  try {
    for (std::string_view rest = trimmed(list); !rest.empty(); rest = trimmed(rest)) {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n\f"));
      result.push_back(length(word, {whole, entered.style.font.size, entered.context.viewport}));
      rest.remove_prefix(word.size());
    }
  } catch (const Malformed& problem) {
    scene_.notes_.say(scene_.document_.where(node) + ": " + name + ": " + problem.what() + "; it is skipped");
  }
  return result;
}

void SvgText::open(const pugi::xml_node& node, const Entered& entered) {
  const Vec2& whole = entered.context.viewport;
  Places places;
  places.first = letters_.size();
  places.x = lengths(node, entered, "x", whole.x());
  places.y = lengths(node, entered, "y", whole.y());
  places.dx = lengths(node, entered, "dx", whole.x());
  places.dy = lengths(node, entered, "dy", whole.y());
  for (const double degrees : lengths(node, entered, "rotate", 0))
    places.turn.push_back(degrees * std::numbers::pi / 180);
  places_.push_back(std::move(places));
}

void SvgText::collect(const pugi::xml_node& node, const Entered& entered, double baseline) {
  const auto say = [&](Finding finding) {
    if (scene_.purpose_ == Scene::Purpose::paint) scene_.notes_.add(finding, scene_.document_.where(node));
  };
  const Style& style = entered.style;
  if (style.font.vertical || style.font.decorated || node.attribute("textLength")) say(Finding::text_look);
  baseline += style.baseline_shift;
  open(node, entered);
  runs_.push_back({node, entered, baseline + base_of(style)});
  const std::size_t run = run_at_.size();
  run_at_.push_back(&runs_.back());
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
      add_text(child.value(), run);
      continue;
    }
    const std::string_view name = scene_.document_.name(child);
    if (name == "tref") {
      if (const auto inner = scene_.enter(child, entered.context)) quote(child, *inner, baseline);
    } else if (name == "textPath") {
      say(Finding::text_on_path);
    } else if ((name == "tspan" || name == "a") && entered.context.depth < 256) {
      if (const auto inner = scene_.enter(child, entered.context)) collect(child, *inner, baseline);
    }
  }
  places_.pop_back();
}

/// The text of another element (SVG 1.1, section 10.6).
void SvgText::quote(const pugi::xml_node& node, const Entered& entered, double baseline) {
  open(node, entered);
  runs_.push_back({node, entered, baseline + base_of(entered.style)});
  run_at_.push_back(&runs_.back());
  const pugi::xml_node target = scene_.document_.linked(node);
  if (target) {
    add_text(target.text().get(), run_at_.size() - 1);
  } else {
    scene_.notes_.add(Finding::missing_target, scene_.document_.where(node));
  }
  places_.pop_back();
}

void SvgText::add_text(const char* text, std::size_t run) {
  const bool keep = run_at_[run]->entered.style.font.keep_spaces;
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t size = std::max<std::size_t>(1, utf8_size(all.substr(at)));
    Letter letter;
    letter.bytes = all.substr(at, size);
    at += size;
    if (is_white_space(letter.bytes.front())) {
      letter.bytes = " ";
      if (after_space_ && !keep) continue;
    }
    after_space_ = letter.bytes == " ";
    if (letters_.size() >= most_letters) throw Malformed("the text has more than 100000 letters");
    letter.run = run;
    place_letter(letter);
    letters_.push_back(std::move(letter));
  }
}

/// Positions come from the innermost element whose list reaches this letter.
void SvgText::place_letter(Letter& letter) {
  const std::size_t index = letters_.size();
  for (const Places& places : places_) {
    const std::size_t i = index - places.first;
    if (const auto x = entry(places.x, i)) letter.x = x;
    if (const auto y = entry(places.y, i)) letter.y = y;
    letter.dx = entry(places.dx, i).value_or(letter.dx);
    letter.dy = entry(places.dy, i).value_or(letter.dy);
    if (!places.turn.empty()) letter.turn = places.turn[std::min(i, places.turn.size() - 1)];
  }
}

/// The letters that are shaped together: of one element, and none of them moved by itself.
std::size_t SvgText::segment_end(std::size_t from) const {
  std::size_t to = from + 1;
  while (to < letters_.size() && letters_[to].run == letters_[from].run && !letters_[to].x &&
         !letters_[to].y && letters_[to].dx == 0 && letters_[to].dy == 0 && letters_[to].turn == 0 &&
         letters_[from].turn == 0)
    ++to;
  return to;
}

void SvgText::lay_segment(std::size_t from, std::size_t to, Vec2& pen) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) text += letters_[i].bytes;
  const Run& run = *run_at_[letters_[from].run];
  const FontStyle& font = run.entered.style.font;
  const std::vector<Glyph> glyphs = scene_.fonts_.line(text, request(font));
  for (std::size_t i = 0; i < glyphs.size(); ++i) {
    placed_.push_back({glyphs[i], letters_[from].run, pen - Vec2(0, run.baseline), letters_[from].turn});
    pen.x() += glyphs[i].advance * font.size;
    const bool last_of_cluster = i + 1 == glyphs.size() || glyphs[i + 1].cluster != glyphs[i].cluster;
    if (last_of_cluster) pen.x() += font.letter_spacing;
    if (last_of_cluster && text[std::min(glyphs[i].cluster, text.size() - 1)] == ' ')
      pen.x() += font.word_spacing;
  }
}

void SvgText::lay_out() {
  Vec2 pen(0, 0);
  std::size_t first_glyph = 0, first_letter = 0;
  double chunk_start = 0;
  for (std::size_t i = 0; i < letters_.size();) {
    const Letter& letter = letters_[i];
    if (letter.x || letter.y) {
      if (i > 0) anchor(first_glyph, letters_[first_letter], pen.x() - chunk_start);
      pen = {letter.x.value_or(pen.x()), letter.y.value_or(pen.y())};
      first_glyph = placed_.size();
      first_letter = i;
      chunk_start = pen.x();
    }
    pen += Vec2(letter.dx, letter.dy);
    const std::size_t end = segment_end(i);
    lay_segment(i, end, pen);
    i = end;
  }
  if (!letters_.empty()) anchor(first_glyph, letters_[first_letter], pen.x() - chunk_start);
}

/// Moves a chunk of text, which begins at an absolute position, by text-anchor.
void SvgText::anchor(std::size_t first_glyph, const Letter& first, double width) {
  const auto where = run_at_[first.run]->entered.style.font.anchor;
  if (where == FontStyle::Anchor::start) return;
  const double shift = where == FontStyle::Anchor::middle ? width / 2 : width;
  for (std::size_t i = first_glyph; i < placed_.size(); ++i) placed_[i].at.x() -= shift;
}

}  // namespace unicursal::core
