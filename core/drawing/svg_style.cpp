#include "core/drawing/svg_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "core/drawing/svg_frame.hpp"
#include "core/error.hpp"
#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

/// What values are read with.
struct Reading {
  const InheritedStyle& parent;
  double whole = 0;

  LengthFrame frame(const Style& style) const { return {whole, style.font.size}; }
};

/// Reads a value into a style; throws Malformed or returns false if it is invalid.
using Set = bool (*)(Style&, std::string_view, const Reading&);
/// Copies the property from one style to another.
using Copy = void (*)(Style&, const Style&);

struct Property {
  Set set;
  Copy copy;
  bool inherited = true;
  bool attribute = true;  ///< whether it is a presentation attribute
};

std::optional<Paint> paint(std::string_view value) {
  Paint result;
  const std::string word = lower(value);
  if (word == "none") return result;
  if (word == "currentcolor") return Paint{Paint::Kind::current_colour, {}, {}, false, false};
  if (word == "context-fill") return Paint{Paint::Kind::context_fill, {}, {}, false, false};
  if (word == "context-stroke") return Paint{Paint::Kind::context_stroke, {}, {}, false, false};
  if (word.starts_with("url(")) {
    const auto end = value.find(')');
    if (end == std::string_view::npos) return std::nullopt;
    result.kind = Paint::Kind::server;
    result.server = id_in(value);
    const std::string_view fallback = trimmed(value.substr(end + 1));
    if (fallback == "none") {
      result.has_fallback = result.fallback_is_none = true;
    } else if (lower(fallback) == "currentcolor") {
      result.has_fallback = result.fallback_is_current = true;
    } else if (const auto colour = read_css_colour(fallback)) {
      result.has_fallback = true;
      result.colour = *colour;
    }
    return result;
  }
  const auto icc = value.find("icc-color");
  const auto colour = read_css_colour(value.substr(0, icc));
  if (!colour) return std::nullopt;
  result.kind = Paint::Kind::colour;
  result.colour = *colour;
  return result;
}

bool set_paint(Paint& paint_of, std::string_view value) {
  const auto found = paint(value);
  if (found) paint_of = *found;
  return found.has_value();
}

bool set_share(double& share, std::string_view value) {
  NumberScanner scanner(value);
  double number = scanner.required();
  if (scanner.peek() == '%') {
    number /= 100;
    scanner.advance();
  }
  share = std::clamp(number, 0.0, 1.0);
  return scanner.at_end();
}

bool set_rule(FillRule& rule, std::string_view value) {
  if (value != "evenodd" && value != "nonzero") return false;
  rule = value == "evenodd" ? FillRule::even_odd : FillRule::non_zero;
  return true;
}

/// "stroke fill": what is not named follows in the usual order.
bool set_paint_order(std::string& order, std::string_view value) {
  std::string found;
  for (std::string_view rest = trimmed(value); !rest.empty(); rest = trimmed(rest)) {
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n\f"));
    rest.remove_prefix(word.size());
    if (word == "normal" && value == "normal") continue;
    const bool known = word == "fill" || word == "stroke" || word == "markers";
    if (!known || found.find(word.front()) != std::string::npos) return false;
    found += word.front();
  }
  for (const char kind : std::string_view("fsm")) {
    if (found.find(kind) == std::string::npos) found += kind;
  }
  order = found;
  return true;
}

bool set_link(std::string& id, std::string_view value) {
  if (value != "none" && !value.starts_with("url(")) return false;
  id = id_in(value);
  return true;
}

/// One of the words of `table`.
template <class Value, std::size_t Count>
bool set_word(Value& target, std::string_view value,
              const std::array<std::pair<std::string_view, Value>, Count>& table) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == value; });
  if (found == table.end()) return false;
  target = found->second;
  return true;
}

bool set_dashes(Style& style, std::string_view value, const Reading& reading) {
  std::vector<double> dashes;
  if (value != "none") {
    std::string list(value);
    std::replace(list.begin(), list.end(), ',', ' ');
    for (std::string_view rest = trimmed(list); !rest.empty(); rest = trimmed(rest)) {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n\f"));
      dashes.push_back(length(word, reading.frame(style)));
      if (dashes.back() < 0) return false;
      rest.remove_prefix(word.size());
    }
  }
  style.pen.dashes = std::move(dashes);
  return true;
}

bool set_font_size(Style& style, std::string_view value, const Reading& reading) {
  static constexpr std::array<std::pair<std::string_view, double>, 7> words{{{"xx-small", 9.6},
                                                                             {"x-small", 12.0},
                                                                             {"small", 14.2},
                                                                             {"medium", 16.0},
                                                                             {"large", 19.2},
                                                                             {"x-large", 24.0},
                                                                             {"xx-large", 32.0}}};
  const double outer = reading.parent.font.size;
  if (set_word(style.font.size, value, words)) return true;
  if (value == "smaller" || value == "larger") {
    style.font.size = value == "larger" ? outer * 1.2 : outer / 1.2;
    return true;
  }
  const double size = length(value, LengthFrame{outer, outer});
  if (size < 0) return false;
  style.font.size = size;
  return true;
}

bool set_font_weight(Style& style, std::string_view value, const Reading& reading) {
  static constexpr std::array<std::pair<std::string_view, int>, 2> words{{{"normal", 400}, {"bold", 700}}};
  if (set_word(style.font.weight, value, words)) return true;
  const int outer = reading.parent.font.weight;
  if (value == "bolder") {
    style.font.weight = outer < 350 ? 400 : outer < 550 ? 700 : 900;
  } else if (value == "lighter") {
    style.font.weight = outer < 550 ? 100 : outer < 750 ? 400 : 700;
  } else {
    NumberScanner scanner(value);
    const double weight = scanner.required();
    if (weight < 1 || weight > 1000) return false;
    style.font.weight = static_cast<int>(weight);
  }
  return true;
}

bool set_font_style(Style& style, std::string_view value, const Reading&) {
  style.font.italic = value == "italic" || value.starts_with("oblique");
  return style.font.italic || value == "normal";
}

/// `font: italic bold 12px/1.5 Family, Family`.
bool set_font(Style& style, std::string_view value, const Reading& reading) {
  Style changed = style;
  changed.font = FontStyle{};
  changed.font.anchor = style.font.anchor;
  changed.font.letter_spacing = style.font.letter_spacing;
  changed.font.word_spacing = style.font.word_spacing;
  changed.font.keep_spaces = style.font.keep_spaces;
  while (!value.empty()) {
    const std::string_view word = value.substr(0, value.find_first_of(" \t\r\n\f"));
    value = trimmed(value.substr(word.size()));
    if (set_font_style(changed, word, reading) && word != "normal") continue;
    if (word == "normal" || word == "small-caps") continue;
    const bool number = word.find_first_not_of("0123456789") == std::string_view::npos;
    if ((number || word == "bold" || word == "bolder" || word == "lighter") &&
        set_font_weight(changed, word, reading))
      continue;
    if (!set_font_size(changed, word.substr(0, word.find('/')), reading) || value.empty()) return false;
    changed.font.families = value;
    style.font = changed.font;
    return true;
  }
  return false;
}

bool set_spacing(double& spacing, Style& style, std::string_view value, const Reading& reading) {
  spacing = value == "normal" ? 0 : length(value, reading.frame(style));
  return true;
}

bool set_baseline(Style& style, std::string_view value, const Reading& reading) {
  const double size = reading.parent.font.size;
  if (value == "sub") {
    style.baseline_shift = -size / 5;
  } else if (value == "super") {
    style.baseline_shift = size * 2 / 5;
  } else if (value == "baseline") {
    style.baseline_shift = 0;
  } else {
    style.baseline_shift = length(value, LengthFrame{size, size});
  }
  return true;
}

template <auto Member>
void copy_member(Style& to, const Style& from) {
  to.*Member = from.*Member;
}
template <auto Member>
void copy_pen(Style& to, const Style& from) {
  to.pen.*Member = from.pen.*Member;
}
template <auto Member>
void copy_font(Style& to, const Style& from) {
  to.font.*Member = from.font.*Member;
}

/// The properties that change what is printed. SVG 1.1, appendix N, and SVG 2.
const std::unordered_map<std::string_view, Property>& properties() {
  using S = Style;
  using V = std::string_view;
  using R = const Reading&;
  static constexpr std::array<std::pair<V, Cap>, 3> caps{
      {{"butt", Cap::butt}, {"round", Cap::round}, {"square", Cap::square}}};
  static constexpr std::array<std::pair<V, Join>, 5> joins{{{"miter", Join::miter},
                                                            {"miter-clip", Join::miter},
                                                            {"arcs", Join::miter},
                                                            {"round", Join::round},
                                                            {"bevel", Join::bevel}}};
  using Anchor = FontStyle::Anchor;
  static constexpr std::array<std::pair<V, Anchor>, 3> anchors{
      {{"start", Anchor::start}, {"middle", Anchor::middle}, {"end", Anchor::end}}};
  using Baseline = FontStyle::Baseline;
  static constexpr std::array<std::pair<V, Baseline>, 9> baselines{{{"auto", Baseline::alphabetic},
                                                                    {"alphabetic", Baseline::alphabetic},
                                                                    {"middle", Baseline::middle},
                                                                    {"central", Baseline::central},
                                                                    {"mathematical", Baseline::central},
                                                                    {"hanging", Baseline::hanging},
                                                                    {"text-before-edge", Baseline::hanging},
                                                                    {"text-after-edge", Baseline::bottom},
                                                                    {"ideographic", Baseline::bottom}}};
  static const std::unordered_map<V, Property> table{
      {"color",
       {[](S& s, V v, R) {
          const auto colour = read_css_colour(v);
          if (colour) s.colour = *colour;
          return colour.has_value() || lower(v) == "currentcolor";
        },
        [](S& to, const S& from) { to.colour = from.colour; }}},
      {"fill", {[](S& s, V v, R) { return set_paint(s.fill, v); }, copy_member<&S::fill>}},
      {"stroke", {[](S& s, V v, R) { return set_paint(s.stroke, v); }, copy_member<&S::stroke>}},
      {"fill-opacity",
       {[](S& s, V v, R) { return set_share(s.fill_opacity, v); }, copy_member<&S::fill_opacity>}},
      {"stroke-opacity",
       {[](S& s, V v, R) { return set_share(s.stroke_opacity, v); }, copy_member<&S::stroke_opacity>}},
      {"fill-rule", {[](S& s, V v, R) { return set_rule(s.fill_rule, v); }, copy_member<&S::fill_rule>}},
      {"clip-rule", {[](S& s, V v, R) { return set_rule(s.clip_rule, v); }, copy_member<&S::clip_rule>}},
      {"stroke-width",
       {[](S& s, V v, R r) {
          const double width = length(v, r.frame(s));
          if (width >= 0) s.pen.width = width;
          return width >= 0;
        },
        copy_pen<&StrokeStyle::width>}},
      {"stroke-linecap",
       {[](S& s, V v, R) { return set_word(s.pen.cap, v, caps); }, copy_pen<&StrokeStyle::cap>}},
      {"stroke-linejoin",
       {[](S& s, V v, R) { return set_word(s.pen.join, v, joins); }, copy_pen<&StrokeStyle::join>}},
      {"stroke-miterlimit",
       {[](S& s, V v, R) {
          NumberScanner scanner(v);
          const double limit = scanner.required();
          if (limit < 1 || !scanner.at_end()) return false;
          s.pen.miter_limit = limit;
          return true;
        },
        copy_pen<&StrokeStyle::miter_limit>}},
      {"stroke-dasharray", {set_dashes, copy_pen<&StrokeStyle::dashes>}},
      {"stroke-dashoffset",
       {[](S& s, V v, R r) {
          s.pen.dash_offset = length(v, r.frame(s));
          return true;
        },
        copy_pen<&StrokeStyle::dash_offset>}},
      {"visibility",
       {[](S& s, V v, R) {
          s.visible = v == "visible";
          return s.visible || v == "hidden" || v == "collapse";
        },
        copy_member<&S::visible>}},
      {"paint-order",
       {[](S& s, V v, R) { return set_paint_order(s.paint_order, v); }, copy_member<&S::paint_order>}},
      {"marker-start",
       {[](S& s, V v, R) { return set_link(s.marker_start, v); }, copy_member<&S::marker_start>}},
      {"marker-mid", {[](S& s, V v, R) { return set_link(s.marker_mid, v); }, copy_member<&S::marker_mid>}},
      {"marker-end", {[](S& s, V v, R) { return set_link(s.marker_end, v); }, copy_member<&S::marker_end>}},
      {"marker",
       {[](S& s, V v, R) {
          if (!set_link(s.marker_start, v)) return false;
          s.marker_mid = s.marker_end = s.marker_start;
          return true;
        },
        [](S& to, const S& from) {
          to.marker_start = from.marker_start;
          to.marker_mid = from.marker_mid;
          to.marker_end = from.marker_end;
        },
        true, false}},
      {"font", {set_font, copy_member<&S::font>, true, false}},
      {"font-family",
       {[](S& s, V v, R) {
          s.font.families = v;
          return !v.empty();
        },
        copy_font<&FontStyle::families>}},
      {"font-size", {set_font_size, copy_font<&FontStyle::size>}},
      {"font-weight", {set_font_weight, copy_font<&FontStyle::weight>}},
      {"font-style", {set_font_style, copy_font<&FontStyle::italic>}},
      {"letter-spacing",
       {[](S& s, V v, R r) { return set_spacing(s.font.letter_spacing, s, v, r); },
        copy_font<&FontStyle::letter_spacing>}},
      {"word-spacing",
       {[](S& s, V v, R r) { return set_spacing(s.font.word_spacing, s, v, r); },
        copy_font<&FontStyle::word_spacing>}},
      {"text-anchor",
       {[](S& s, V v, R) { return set_word(s.font.anchor, v, anchors); }, copy_font<&FontStyle::anchor>}},
      {"white-space",
       {[](S& s, V v, R) {
          s.font.keep_spaces = v.starts_with("pre");
          return true;
        },
        copy_font<&FontStyle::keep_spaces>, true, false}},
      {"writing-mode",
       {[](S& s, V v, R) {
          s.font.vertical = v.starts_with("tb") || v.starts_with("vertical");
          return true;
        },
        copy_font<&FontStyle::vertical>}},
      {"text-decoration",
       {[](S& s, V v, R) {
          s.font.decorated = v != "none";
          return true;
        },
        copy_font<&FontStyle::decorated>}},
      {"dominant-baseline",
       {[](S& s, V v, R) { return set_word(s.font.baseline, v, baselines); },
        copy_font<&FontStyle::baseline>}},
      {"display",
       {[](S& s, V v, R) {
          s.displayed = v != "none";
          return true;
        },
        copy_member<&S::displayed>, false}},
      {"opacity", {[](S& s, V v, R) { return set_share(s.opacity, v); }, copy_member<&S::opacity>, false}},
      {"overflow",
       {[](S& s, V v, R) {
          s.overflow_visible = v == "visible" || v == "auto";
          return true;
        },
        copy_member<&S::overflow_visible>, false}},
      {"clip-path",
       {[](S& s, V v, R) { return set_link(s.clip_path, v); }, copy_member<&S::clip_path>, false}},
      {"mask", {[](S& s, V v, R) { return set_link(s.mask, v); }, copy_member<&S::mask>, false}},
      {"filter",
       {[](S& s, V v, R) {
          s.filter = v == "none" ? V{} : v;
          return true;
        },
        copy_member<&S::filter>, false}},
      {"mix-blend-mode",
       {[](S& s, V v, R) {
          s.blend = v == "normal" ? V{} : v;
          return true;
        },
        copy_member<&S::blend>, false, false}},
      {"transform",
       {[](S& s, V v, R) {
          s.transform = std::string(v);
          return true;
        },
        copy_member<&S::transform>, false, false}},
      {"transform-origin",
       {[](S& s, V v, R) {
          s.transform_origin = v;
          return true;
        },
        copy_member<&S::transform_origin>, false}},
      {"transform-box",
       {[](S& s, V v, R) {
          s.transform_box_is_fill_box = v == "fill-box" || v == "content-box";
          return true;
        },
        copy_member<&S::transform_box_is_fill_box>, false}},
      {"mask-type",
       {[](S& s, V v, R) {
          s.mask_by_alpha = v == "alpha";
          return true;
        },
        copy_member<&S::mask_by_alpha>, false}},
      {"vector-effect",
       {[](S& s, V v, R) {
          s.stroke_keeps_width = v == "non-scaling-stroke";
          return true;
        },
        copy_member<&S::stroke_keeps_width>, false}},
      {"stop-color",
       {[](S& s, V v, R) {
          const auto colour = lower(v) == "currentcolor" ? std::optional(s.colour) : read_css_colour(v);
          if (colour) s.stop_colour = *colour;
          return colour.has_value();
        },
        copy_member<&S::stop_colour>, false}},
      {"stop-opacity",
       {[](S& s, V v, R) { return set_share(s.stop_opacity, v); }, copy_member<&S::stop_opacity>, false}},
      {"baseline-shift", {set_baseline, copy_member<&S::baseline_shift>, false}},
  };
  return table;
}

bool is_geometry(std::string_view name) {
  static constexpr std::array<std::string_view, 10> names{"x",  "y", "width", "height", "cx",
                                                          "cy", "r", "rx",    "ry",     "d"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Cascade {
 public:
  Cascade(const pugi::xml_node& node, const InheritedStyle& parent, double whole, const StyleSource& source)
      : node_(node), parent_(parent), reading_{parent, whole}, source_(source) {
    static_cast<InheritedStyle&>(style_) = parent;
  }

  Style resolve() {
    collect();
    // Other lengths may refer to the size of the font, and stops to the colour.
    const auto goes_first = [](const Declaration& d) {
      return d.name == "font-size" || d.name == "font" || d.name == "color";
    };
    for (const Declaration& declaration : all_) {
      if (goes_first(declaration)) apply(declaration);
    }
    for (const Declaration& declaration : all_) {
      if (!goes_first(declaration)) apply(declaration);
    }
    return std::move(style_);
  }

 private:
  void collect() {
    const auto& known = properties();
    for (const auto& attribute : node_.attributes()) {
      const std::string_view name = attribute.name();
      if (name == "xml:space") {
        style_.font.keep_spaces = std::string_view(attribute.value()) == "preserve";
        continue;
      }
      const auto found = known.find(name);
      if (found != known.end() && found->second.attribute)
        all_.push_back({name, trimmed(attribute.value()), false});
    }
    std::vector<Declaration> strong, entries;
    try {
      if (!source_.sheet.empty()) entries = source_.sheet.matching(node_, source_.document.name(node_));
    } catch (const Malformed& problem) {
      throw ModelError(source_.document.file(), source_.document.where(node_), problem.what(),
                       "simplify its style sheets");
    }
    add(entries, strong);
    if (const auto style = node_.attribute("style")) {
      std::string_view text = style.value();
      if (text.find("/*") != std::string_view::npos) {
        text_ = without_comments(text);
        text = text_;
      }
      entries = declarations(text, source_.document.where(node_), source_.notes);
      add(entries, strong);
    }
    all_.insert(all_.end(), strong.begin(), strong.end());
  }

  void add(const std::vector<Declaration>& entries, std::vector<Declaration>& strong) {
    for (const Declaration& entry : entries) (entry.important ? strong : all_).push_back(entry);
  }

  void apply(const Declaration& declaration) {
    const auto found = properties().find(declaration.name);
    if (found == properties().end()) {
      if (is_geometry(declaration.name)) style_.geometry.emplace_back(declaration.name, declaration.value);
      return;
    }
    const Property& property = found->second;
    const std::string_view value = declaration.value;
    if (value == "inherit" || value == "initial" || value == "unset" || value == "revert") {
      static const Style initial;
      Style outer;
      static_cast<InheritedStyle&>(outer) = parent_;
      const bool inherits = value == "inherit" || (value != "initial" && property.inherited);
      property.copy(style_, inherits ? outer : initial);
      return;
    }
    bool valid = false;
    try {
      valid = property.set(style_, value, reading_);
    } catch (const Malformed&) {
    }
    if (!valid && !value.empty()) {
      source_.notes.add(source_.document.where(node_) + ": " + std::string(declaration.name) + " cannot be " +
                        in_quotes(value) + "; it is skipped");
    }
  }

  const pugi::xml_node& node_;
  const InheritedStyle& parent_;
  Reading reading_;
  const StyleSource& source_;
  Style style_;
  std::vector<Declaration> all_;  ///< in the order in which they are applied
  std::string text_;
};

}  // namespace

Style styled(const pugi::xml_node& node, const InheritedStyle& parent, double whole,
             const StyleSource& source) {
  return Cascade(node, parent, whole, source).resolve();
}

}  // namespace unicursal::core
