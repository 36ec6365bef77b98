#include "core/drawing/svg_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/drawing/svg_path.hpp"
#include "core/drawing/svg_shapes.hpp"
#include "core/drawing/svg_transform.hpp"
#include "core/error.hpp"
#include "core/stopping.hpp"
#include "core/text/malformed.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr int deepest_nesting = 256;              ///< of elements; deeper nesting could overflow the stack
constexpr std::size_t most_elements = 2'000'000;  ///< drawn, each clone counted
constexpr std::size_t most_points = 20'000'000;
constexpr double page_tolerance = 0.01;      ///< mm that are left out without a note
constexpr std::size_t between_stops = 1000;  ///< elements

bool any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_shape(std::string_view name) {
  return any_of(name, {"path", "rect", "circle", "ellipse", "line", "polygon", "polyline"});
}

bool is_group(std::string_view name) {
  return any_of(name, {"g", "a", "svg", "switch", "use"});
}

/// Whether a list of languages, separated by commas, holds English.
bool english(std::string_view languages) {
  while (!languages.empty()) {
    const std::string_view one = trimmed(languages.substr(0, languages.find(',')));
    if (one == "en" || one.starts_with("en-")) return true;
    const auto comma = languages.find(',');
    languages.remove_prefix(comma == std::string_view::npos ? languages.size() : comma + 1);
  }
  return false;
}

/// The conditions of SVG 1.1, section 5.8. Extensions are never there.
bool conditions_hold(const pugi::xml_node& node) {
  const auto languages = node.attribute("systemLanguage");
  const auto extensions = node.attribute("requiredExtensions");
  return (!languages || english(languages.value())) && (!extensions || trimmed(extensions.value()).empty());
}

std::shared_ptr<const Names> names_of(const pugi::xml_node& node, const std::shared_ptr<const Names>& outer) {
  std::vector<std::string> own;
  for (const char* key : {"id", "inkscape:label", "name"}) {
    if (const auto attribute = node.attribute(key)) own.push_back(name_in(attribute.value()));
  }
  if (own.empty()) return outer;
  return std::make_shared<const Names>(Names{std::move(own), outer});
}

bool holds_node(const pugi::xml_node& outer, pugi::xml_node node) {
  for (; node; node = node.parent()) {
    if (node == outer) return true;
  }
  return false;
}

double diagonal(const Vec2& viewport) {
  return viewport.norm() / std::sqrt(2.0);
}

}  // namespace

Scene::Scene(const SvgDocument& document, const StyleSheet& sheet, DrawingNotes& notes,
             bool strokes_are_contours)
    : document_(document),
      sheet_(sheet),
      notes_(notes),
      fonts_(notes.sentences()),
      strokes_are_contours_(strokes_are_contours) {}

void Scene::walk(const Page& page, const Eigen::Matrix2d& turn) {
  page_ = page;
  const pugi::xml_node root = document_.root();
  Context outside;
  outside.to_part = Eigen::Affine2d(turn) * page.to_part;
  outside.viewport = page.size;
  page_.to_part = outside.to_part;
  auto entered = enter(root, outside);
  if (!entered) return;
  Context context = entered->context;
  root_font_size_ = entered->style.font.size;
  context.names = nullptr;  // the page's own name would match everything
  if (page.known && !entered->style.overflow_visible) {
    narrow(context, mapped_box(Eigen::Affine2d(turn), {{0, 0}, page.paper}));
    page_clip_ = context.clip;
    if (!page_clip_->empty()) around_page_ = bounds(*page_clip_);
    around_page_.min -= Vec2::Constant(page_tolerance);
    around_page_.max += Vec2::Constant(page_tolerance);
  }
  children(root, context);
}

void Scene::spend(const pugi::xml_node& node, std::size_t elements, std::size_t points) {
  if (elements_ / between_stops != (elements_ + elements) / between_stops) stop_point();
  elements_ += elements;
  points_ += points;
  if (elements_ > most_elements || points_ > most_points) {
    throw ModelError(document_.file(), document_.where(node),
                     fmt::format("up to here the drawing has more than {} million {}, clones counted",
                                 (elements_ > most_elements ? most_elements : most_points) / 1'000'000,
                                 elements_ > most_elements ? "elements" : "points"),
                     "simplify it");
  }
}

void Scene::children(const pugi::xml_node& node, const Context& context) {
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_element) element(child, context);
  }
}

bool Scene::is_renderable(const pugi::xml_node& node) const {
  const std::string_view name = document_.name(node);
  return is_group(name) || is_shape(name) || any_of(name, {"text", "image", "foreignObject"});
}

void Scene::element(const pugi::xml_node& node, const Context& context) {
  if (!is_renderable(node) || !conditions_hold(node)) return;
  if (context.depth > deepest_nesting) {
    throw ModelError(document_.file(), document_.where(node),
                     fmt::format("groups are nested more than {} deep", deepest_nesting),
                     "ungroup the drawing");
  }
  try {
    if (const auto entered = enter(node, context)) content(node, *entered);
  } catch (const Malformed& problem) {
    notes_.say(fmt::format("{}: {}; it is left out", document_.where(node), problem.what()));
  }
}

std::optional<Entered> Scene::enter(const pugi::xml_node& node, const Context& outer) {
  spend(node, 1, 0);
  Entered result{styled(node, outer.style, diagonal(outer.viewport), source()), outer};
  const Style& style = result.style;
  if (!style.displayed) return std::nullopt;
  Context& context = result.context;
  context.style = style;
  context.depth = outer.depth + 1;
  context.opacity = outer.opacity * style.opacity;
  context.names = names_of(node, outer.names);
  context.to_part = outer.to_part * own_transform(node, result);
  if (context.to_part.linear().determinant() == 0) return std::nullopt;
  if (purpose_ == Purpose::measure) return result;
  if (!style.filter.empty()) notes_.add(Finding::filter, document_.where(node));
  if (!style.blend.empty()) notes_.add(Finding::blend, document_.where(node));
  if (!style.clip_path.empty() || !style.mask.empty()) cut(node, result);
  return result;
}

Eigen::Affine2d Scene::own_transform(const pugi::xml_node& node, const Entered& entered) {
  const Style& style = entered.style;
  const auto attribute = node.attribute("transform");
  if (!style.transform && !attribute) return Eigen::Affine2d::Identity();
  const std::string text = style.transform ? *style.transform : std::string(attribute.value());
  try {
    TransformFrame frame;
    frame.font_size = style.font.size;
    frame.box = {{0, 0}, entered.context.viewport};
    if (style.transform_box_is_fill_box && purpose_ != Purpose::measure) {
      Entered bare{style, entered.context};
      frame.box = box_of(node, bare);
    }
    const Eigen::Affine2d map = transform(text, frame);
    if (style.transform_origin.empty() && !style.transform_box_is_fill_box) return map;
    const Vec2 origin =
        style.transform_origin.empty() ? frame.box.min : transform_origin(style.transform_origin, frame);
    return Eigen::Translation2d(origin) * map * Eigen::Translation2d(-origin);
  } catch (const Malformed& problem) {
    notes_.say(fmt::format("{}: {}; its transform is skipped", document_.where(node), problem.what()));
    return Eigen::Affine2d::Identity();
  }
}

void Scene::content(const pugi::xml_node& node, const Entered& entered) {
  const std::string_view name = document_.name(node);
  if (is_shape(name)) return shape(node, entered);
  if (name == "text") return text(node, entered);
  if (name == "use") return clone(node, entered);
  if (purpose_ == Purpose::clip) return;  // clip paths hold shapes, text and clones of these
  const Context& context = entered.context;
  if (name == "switch") return choose(node, context);
  if (name == "svg") {
    const Vec2 corner(length_or(node, entered, "x", context.viewport.x(), 0),
                      length_or(node, entered, "y", context.viewport.y(), 0));
    const Vec2 size(length_or(node, entered, "width", context.viewport.x(), context.viewport.x()),
                    length_or(node, entered, "height", context.viewport.y(), context.viewport.y()));
    return viewport(node, entered.style, context, corner, size);
  }
  if (name == "image" || name == "foreignObject") {
    if (purpose_ == Purpose::paint && entered.style.visible)
      notes_.add(name == "image" ? Finding::picture : Finding::foreign, document_.where(node));
    return;
  }
  children(node, context);
}

void Scene::choose(const pugi::xml_node& node, const Context& context) {
  for (const pugi::xml_node& child : node.children()) {
    if (!is_renderable(child) || !conditions_hold(child)) continue;
    return element(child, context);
  }
}

void Scene::viewport(const pugi::xml_node& node, const Style& style, Context context, const Vec2& corner,
                     const Vec2& size) {
  if (!(size.x() > 0 && size.y() > 0)) return;
  const Eigen::Affine2d placed = context.to_part * Eigen::Translation2d(corner);
  if (!style.overflow_visible && purpose_ == Purpose::paint) {
    narrow(context, mapped_box(placed, {{0, 0}, size}));
  }
  context.to_part = placed;
  context.viewport = size;
  try {
    if (const auto view = view_box(node.attribute("viewBox").value())) {
      context.to_part = placed * fitted(*view, size, node.attribute("preserveAspectRatio").value());
      context.viewport = view->size();
    }
  } catch (const Malformed& problem) {
    notes_.say(fmt::format("{}: {}; it is skipped", document_.where(node), problem.what()));
  }
  children(node, context);
}

bool Scene::in_use(const pugi::xml_node& node) const {
  return std::find(open_.begin(), open_.end(), node) != open_.end();
}

void Scene::clone(const pugi::xml_node& node, const Entered& entered) {
  const pugi::xml_node target = document_.linked(node);
  if (!target) {
    if (!link_of(node).empty()) notes_.add(Finding::missing_target, document_.where(node));
    return;
  }
  if (in_use(target) || holds_node(target, node))
    return notes_.add(Finding::circle_of_links, document_.where(node));
  const std::string_view name = document_.name(target);
  if (purpose_ == Purpose::clip && !is_shape(name) && name != "text") return;
  Context context = entered.context;
  mark(context, entered.style);
  const Vec2 whole = context.viewport;
  const Vec2 corner(length_or(node, entered, "x", whole.x(), 0), length_or(node, entered, "y", whole.y(), 0));
  const auto width = optional_length(node, entered, "width", whole.x()),
             height = optional_length(node, entered, "height", whole.y());
  context.to_part = context.to_part * Eigen::Translation2d(corner);
  const Opened opened(open_, target);
  if (name == "svg" || name == "symbol") {
    if (const auto inner = enter(target, context)) {
      const auto side = [&](const char* key, double all) {
        return name == "svg" ? length_or(target, *inner, key, all, all) : all;
      };
      const Vec2 size(width.value_or(side("width", whole.x())), height.value_or(side("height", whole.y())));
      const Vec2 shift = name == "svg" ? Vec2(length_or(target, *inner, "x", whole.x(), 0),
                                              length_or(target, *inner, "y", whole.y(), 0))
                                       : Vec2(0, 0);
      viewport(target, inner->style, inner->context, shift, size);
    }
  } else {
    element(target, context);
  }
}

InheritedStyle Scene::style_around(const pugi::xml_node& node) {
  std::vector<pugi::xml_node> outer;
  for (pugi::xml_node n = node.parent(); n && n.type() == pugi::node_element; n = n.parent()) {
    outer.push_back(n);
    if (outer.size() > std::size_t(deepest_nesting)) throw Malformed("it is nested too deeply");
  }
  spend(node, outer.size(), 0);
  InheritedStyle style;
  for (auto n = outer.rbegin(); n != outer.rend(); ++n) {
    const Style next = styled(*n, style, diagonal(page_.size), source());
    style = next;
  }
  return style;
}

std::optional<double> Scene::optional_length(const pugi::xml_node& node, const Entered& entered,
                                             const char* name, double whole) {
  std::string_view text = node.attribute(name).value();
  for (const auto& [key, value] : entered.style.geometry) {
    if (key == name) text = value;
  }
  text = trimmed(text);
  if (text.empty() || text == "auto") return std::nullopt;
  try {
    return length(text, {whole, entered.style.font.size, page_.size, root_font_size_});
  } catch (const Malformed& problem) {
    notes_.say(fmt::format("{}: {}: {}; it is skipped", document_.where(node), name, problem.what()));
    return std::nullopt;
  }
}

double Scene::length_or(const pugi::xml_node& node, const Entered& entered, const char* name, double whole,
                        double otherwise) {
  return optional_length(node, entered, name, whole).value_or(otherwise);
}

Box Scene::box_of(const pugi::xml_node& node, const Entered& entered) {
  const Purpose before = std::exchange(purpose_, Purpose::measure);
  const auto outer_box = std::exchange(measured_, std::nullopt);
  const Eigen::Affine2d outer_frame = std::exchange(measured_from_, entered.context.to_part.inverse());
  try {
    content(node, entered);
  } catch (const Malformed&) {  // the walk that paints says so
  }
  purpose_ = before;
  measured_from_ = outer_frame;
  return std::exchange(measured_, outer_box).value_or(Box{});
}

void Scene::shape(const pugi::xml_node& node, const Entered& entered) {
  paint(node, entered, [&](Outline& outline) { draw(node, entered, outline); });
}

void Scene::draw(const pugi::xml_node& node, const Entered& entered, Outline& outline) {
  const std::string_view name = document_.name(node);
  const double w = entered.context.viewport.x(), h = entered.context.viewport.y(),
               d = diagonal(entered.context.viewport);
  const auto at = [&](const char* key, double whole) { return length_or(node, entered, key, whole, 0); };
  const auto size = [&](const char* key, double whole) {
    const double value = at(key, whole);
    if (value < 0) throw Malformed(fmt::format("{} must not be negative", key));
    return value;
  };
  // A radius that is not valid is as if it were absent: it follows the other one.
  const auto radius = [&](const char* key, double whole) -> std::optional<double> {
    const auto value = optional_length(node, entered, key, whole);
    if (!value || *value >= 0) return value;
    notes_.say(fmt::format("{}: {} must not be negative; it is skipped", document_.where(node), key));
    return std::nullopt;
  };
  std::optional<std::string> mistake;
  if (name == "path") {
    std::string_view data = node.attribute("d").value();
    for (const auto& [key, value] : entered.style.geometry) {
      const auto open = value.find_first_of("'\""), close = value.find_last_of("'\"");
      if (key == "d") data = value;
      if (key == "d" && open < close) data = data.substr(open + 1, close - open - 1);
    }
    mistake = draw_path(data, outline);
  } else if (name == "rect") {
    draw_rect(
        {{at("x", w), at("y", h)}, {size("width", w), size("height", h)}, radius("rx", w), radius("ry", h)},
        outline);
  } else if (name == "circle") {
    draw_ellipse({at("cx", w), at("cy", h)}, Vec2::Constant(size("r", d)), outline);
  } else if (name == "ellipse") {
    const auto rx = radius("rx", w), ry = radius("ry", h);
    draw_ellipse({at("cx", w), at("cy", h)}, {rx.value_or(ry.value_or(0)), ry.value_or(rx.value_or(0))},
                 outline);
  } else if (name == "line") {
    outline.move_to({at("x1", w), at("y1", h)});
    outline.line_to({at("x2", w), at("y2", h)});
  } else {
    mistake = draw_points(node.attribute("points").value(), name == "polygon", outline);
  }
  if (mistake) notes_.say(fmt::format("{}: {}; it is drawn up to there", document_.where(node), *mistake));
}

}  // namespace unicursal::core
