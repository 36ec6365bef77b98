// The part of Scene that turns outlines into areas: fills, strokes, markers, and what covers what.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/drawing/stroke.hpp"
#include "core/drawing/svg_gradient.hpp"
#include "core/drawing/svg_scene.hpp"
#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

constexpr double widest_stroke = farthest_coordinate;  ///< mm

bool within(const Box& inner, const Box& outer) {
  return (inner.min.array() >= outer.min.array()).all() && (inner.max.array() <= outer.max.array()).all();
}
bool apart(const Box& a, const Box& b) {
  return (a.min.array() > b.max.array()).any() || (b.min.array() > a.max.array()).any();
}

/// A rectangle along the axes, as the page and most clips are.
bool is_box(const Region& region) {
  return region.size() == 1 && region.front().holes.empty() &&
         std::abs(area(region) - bounds(region).size().prod()) <= 1e-9 * area(region);
}

/// The maps user units → frame in which the pen is round → part's frame. Lengths of the second are mm.
struct PenFrame {
  Eigen::Affine2d to_pen, to_part;
  double scale = 1;  ///< mm per user unit, in the frame of the pen
};

PenFrame pen_frame(const Eigen::Affine2d& user_to_part) {
  constexpr double similar = 1e-9;
  const Eigen::Matrix2d m = user_to_part.linear();
  PenFrame frame;
  frame.scale = std::sqrt(std::abs(m.determinant()));
  const Eigen::Matrix2d square = m.transpose() * m / (frame.scale * frame.scale);
  if ((square - Eigen::Matrix2d::Identity()).norm() < similar) {
    frame.to_pen = user_to_part;
    frame.to_part = Eigen::Affine2d::Identity();
  } else {
    frame.to_pen = Eigen::Affine2d(Eigen::Scaling(frame.scale));
    frame.to_part = user_to_part * Eigen::Scaling(1 / frame.scale);
  }
  return frame;
}

double length_of(const std::vector<Subpath>& line) {
  double sum = 0;
  for (const Subpath& path : line) {
    const std::size_t n = path.points.size();
    for (std::size_t i = 1; i < n; ++i) sum += (path.points[i] - path.points[i - 1]).norm();
    if (path.closed && n > 1) sum += (path.points.front() - path.points.back()).norm();
  }
  return sum;
}

double angle_of(const Vec2& direction) {
  return std::atan2(direction.y(), direction.x());
}

/// The direction of a marker: half-way between arrival and departure.
double marker_angle(const PathVertex& vertex) {
  const Vec2 none(0, 0);
  if (vertex.in == none) return angle_of(vertex.out);
  if (vertex.out == none) return angle_of(vertex.in);
  const Vec2 mean = vertex.in.normalized() + vertex.out.normalized();
  return mean.norm() > 1e-9 ? angle_of(mean) : angle_of(vertex.in) + std::numbers::pi / 2;
}

}  // namespace

Outline Scene::outlined(const pugi::xml_node& node, const Eigen::Affine2d& map, const Draw& draw) {
  Outline outline(map);
  draw(outline);
  spend(node, 0, outline.point_count());
  return outline;
}

void Scene::paint(const pugi::xml_node& node, const Entered& entered, const Draw& draw) {
  const Style& style = entered.style;
  const Context& context = entered.context;
  if (purpose_ == Purpose::measure) {
    const Outline outline = outlined(node, context.to_part, draw);
    for (const Subpath& path : outline.subpaths()) {
      for (const Vec2& p : path.points) {
        const Vec2 q = measured_from_ * p;
        if (!measured_) measured_ = Box{q, q};
        measured_->min = measured_->min.cwiseMin(q);
        measured_->max = measured_->max.cwiseMax(q);
      }
    }
    return;
  }
  if (!style.visible) return;
  if (purpose_ == Purpose::clip) {
    const Outline outline = outlined(node, context.to_part, draw);
    Region region = seen(enclosed(outline.rings(), style.clip_rule), context);
    if (!region.empty()) pieces_.push_back({std::move(region), {}, 1, 1, true, nullptr, node});
    return;
  }
  for (const char kind : style.paint_order) {
    if (kind == 'f') fill(node, entered, draw);
    if (kind == 's') stroke(node, entered, draw);
    if (kind == 'm') markers(node, entered, draw);
  }
}

void Scene::fill(const pugi::xml_node& node, const Entered& entered, const Draw& draw) {
  const Style& style = entered.style;
  if (style.fill.kind == Paint::Kind::none || style.fill_opacity <= 0) return;
  const Outline outline = outlined(node, entered.context.to_part, draw);
  cover(enclosed(outline.rings(), style.fill_rule), style.fill, style.fill_opacity, node, entered);
}

void Scene::stroke(const pugi::xml_node& node, const Entered& entered, const Draw& draw) {
  const Style& style = entered.style;
  if (style.stroke.kind == Paint::Kind::none || style.stroke_opacity <= 0 || !(style.pen.width > 0)) return;
  const Eigen::Affine2d& to_part = entered.context.to_part;
  PenFrame frame = pen_frame(to_part);
  StrokeStyle pen = style.pen;
  if (style.stroke_keeps_width) {
    frame = {to_part, Eigen::Affine2d::Identity(), std::sqrt(std::abs(page_.to_part.linear().determinant()))};
  }
  pen.width *= frame.scale;
  if (!(pen.width <= widest_stroke)) throw Malformed("its stroke is wider than 100 m");
  const Outline outline = outlined(node, frame.to_pen, draw);
  std::vector<Subpath> line = outline.subpaths();
  if (line.empty()) return;
  const bool filled = style.fill.kind != Paint::Kind::none;
  const bool contour = strokes_are_contours_ && !filled;
  if (pen.width < hairline && !contour) notes_.add(Finding::hairline, document_.where(node));
  if (!filled && (contour || pen.width < hairline)) {
    for (Subpath& path : line) {
      for (Vec2& p : path.points) p = frame.to_part * p;
      contours_.push_back({std::move(path), style.stroke.colour.rgb});
    }
  }
  if (contour || pen.width < hairline) return;
  if (!pen.dashes.empty()) {
    double scale = frame.scale;
    const std::string_view declared = node.attribute("pathLength").value();
    if (const auto whole = NumberScanner(declared).number(); whole && *whole > 0)
      scale = length_of(line) / *whole;
    for (double& dash : pen.dashes) dash *= scale;
    pen.dash_offset *= scale;
    line = dashed(line, pen);
  }
  std::vector<Ring> rings = stroke_rings(line, pen);
  std::size_t points = 0;
  for (Ring& ring : rings) {
    points += ring.size();
    for (Vec2& p : ring) {
      p = frame.to_part * p;
      if (!(p.cwiseAbs().maxCoeff() <= 2 * farthest_coordinate))
        throw Malformed("its stroke reaches 100 m away");
    }
  }
  spend(node, 0, points);
  cover(enclosed(rings, FillRule::non_zero), style.stroke, style.stroke_opacity, node, entered);
}

void Scene::cover(Region region, const Paint& paint, double opacity, const pugi::xml_node& node,
                  const Entered& entered) {
  const Context& context = entered.context;
  if (paint.kind == Paint::Kind::server) return serve(std::move(region), paint, opacity, node, entered);
  if (paint.kind == Paint::Kind::context_fill || paint.kind == Paint::Kind::context_stroke) {
    if (!context.marked) return;
    const bool fill = paint.kind == Paint::Kind::context_fill;
    const Paint& other = fill ? context.marked->fill : context.marked->stroke;
    if (other.kind != Paint::Kind::none) cover(std::move(region), other, opacity, node, entered);
    return;
  }
  const CssColour& colour = paint.kind == Paint::Kind::current_colour ? entered.style.colour : paint.colour;
  emit({std::move(region), colour.rgb, colour.alpha * opacity, luminance(colour), true, nullptr, node},
       context);
}

void Scene::serve(Region region, const Paint& paint, double opacity, const pugi::xml_node& node,
                  const Entered& entered) {
  const pugi::xml_node server = document_.by_id(paint.server);
  const std::string_view kind = document_.name(server);
  if (is_gradient(kind)) {
    const Gradient found = gradient(server, entered.context.viewport, source());
    if (found.stops.empty()) return;
    if (const auto colour = found.single_colour()) {
      return emit(
          {std::move(region), colour->rgb, colour->alpha * opacity, luminance(*colour), true, nullptr, node},
          entered.context);
    }
    const double alpha = found.mean_alpha();
    if (purpose_ == Purpose::paint && alpha * opacity * entered.context.opacity >= covers_from)
      note_direction(server, found, region, entered.context);
    Piece piece{std::move(region), "url(#" + paint.server + ")", alpha * opacity, 0, false, nullptr, node};
    if (alpha > 0) piece.light = found.mean_light() / alpha;
    return emit(std::move(piece), entered.context);
  }
  if (kind == "pattern") {
    notes_.add(Finding::pattern, document_.where(node));
    return emit({std::move(region), "url(#" + paint.server + ")", opacity, 0, false, nullptr, node},
                entered.context);
  }
  if (paint.has_fallback) {
    if (paint.fallback_is_none) return;
    Paint other;
    other.kind = paint.fallback_is_current ? Paint::Kind::current_colour : Paint::Kind::colour;
    other.colour = paint.colour;
    return cover(std::move(region), other, opacity, node, entered);
  }
  notes_.add(Finding::missing_server, document_.where(node));
}

/// Says once which way a gradient runs, so that a job can give its zone a gradient of mixtures.
void Scene::note_direction(const pugi::xml_node& node, const Gradient& found, const Region& region,
                           const Context& context) {
  const void* identity = node.internal_object();
  if (std::find(described_.begin(), described_.end(), identity) != described_.end()) return;
  described_.push_back(identity);
  std::string way;
  const std::string fill = fmt::format("url(#{})", node.attribute("id").value());
  const GradientStop &first = found.stops.front(), &last = found.stops.back();
  if (found.linear && !region.empty()) {
    Eigen::Affine2d map = context.to_part;
    if (found.by_box) {
      // The box in the part's frame; a turned shape's box is larger, which moves the ends but not the way.
      const Box box = bounds(region);
      map.matrix() << box.size().x(), 0, box.min.x(), 0, -box.size().y(), box.max.y(), 0, 0, 1;
    }
    const Vec2 from = map * (found.transform * found.from), to = map * (found.transform * found.to);
    const Vec2 along = (to - from).normalized();
    way = fmt::format(" along [{:.3g}, {:.3g}, 0]", along.x(), along.y());
    const double length = (to - from).norm(), start = from.dot(along);
    gradients_.push_back({fill, first.colour.rgb, last.colour.rgb, along, start + first.offset * length,
                          start + last.offset * length, found.stops.size() > 2});
  }
  notes_.say(
      fmt::format("{}: it runs from {} to {}{}; it is one zone, select = {}, to which a job can give a "
                  "gradient of mixtures",
                  document_.where(node), first.colour.rgb, last.colour.rgb, way, in_quotes(fill)));
}

Region Scene::seen(Region region, const Context& context) const {
  if (!context.clip || region.empty()) return region;
  if (context.clip->empty()) return {};
  const Box clip = bounds(*context.clip), box = bounds(region);
  if (apart(box, clip)) return {};
  if (within(box, clip) && is_box(*context.clip)) return region;
  return intersect(region, *context.clip);
}

void Scene::emit(Piece piece, const Context& context) {
  if (piece.region.empty()) return;
  piece.alpha *= context.opacity;
  if (piece.alpha <= 0) return;
  if (purpose_ == Purpose::paint && context.clip && context.clip == page_clip_ &&
      !within(bounds(piece.region), around_page_))
    notes_.add(Finding::outside, document_.where(piece.node));
  piece.region = seen(std::move(piece.region), context);
  if (piece.region.empty()) return;
  piece.names = context.names;
  pieces_.push_back(std::move(piece));
}

/// Remembers what context-fill and context-stroke stand for inside of a clone or a marker.
void Scene::mark(Context& context, const InheritedStyle& style) {
  auto known = std::make_shared<InheritedStyle>(style);
  for (Paint* paint : {&known->fill, &known->stroke}) {
    const Paint::Kind kind = paint->kind;
    if (kind != Paint::Kind::context_fill && kind != Paint::Kind::context_stroke) continue;
    *paint = Paint{};
    if (context.marked)
      *paint = kind == Paint::Kind::context_fill ? context.marked->fill : context.marked->stroke;
  }
  context.marked = std::move(known);
}

void Scene::markers(const pugi::xml_node& node, const Entered& entered, const Draw& draw) {
  const Style& style = entered.style;
  const std::string_view name = document_.name(node);
  const bool can_have = name == "path" || name == "line" || name == "polygon" || name == "polyline";
  if (!can_have || (style.marker_start.empty() && style.marker_mid.empty() && style.marker_end.empty()))
    return;
  const Outline outline = outlined(node, entered.context.to_part, draw);
  const auto& vertices = outline.vertices();
  Entered marked = entered;
  mark(marked.context, style);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const bool first = i == 0, last = i + 1 == vertices.size();
    const auto place = [&](const std::string& id) {
      const pugi::xml_node target = document_.by_id(id);
      if (id.empty()) return;
      if (document_.name(target) != "marker")
        return notes_.add(Finding::missing_target, document_.where(node));
      if (in_use(target)) return notes_.add(Finding::circle_of_links, document_.where(node));
      marker(target, marked, vertices[i].at, marker_angle(vertices[i]), first);
    };
    if (first) place(style.marker_start);
    if (!first && !last) place(style.marker_mid);
    if (last) place(style.marker_end);
  }
}

void Scene::marker(const pugi::xml_node& marker, const Entered& entered, const Vec2& at, double angle,
                   bool first) {
  Entered inner{styled(marker, style_around(marker), 0, source()), entered.context};
  spend(marker, price_of_a_cut, 0);
  inner.context.style = inner.style;
  const auto number = [&](const char* name, double whole, double otherwise) {
    return length_or(marker, inner, name, whole, otherwise);
  };
  const Vec2 size(number("markerWidth", 0, 3), number("markerHeight", 0, 3));
  if (!(size.minCoeff() > 0)) return;
  const std::string_view orient = trimmed(marker.attribute("orient").value());
  if (orient.starts_with("auto")) {
    if (orient == "auto-start-reverse" && first) angle += std::numbers::pi;
  } else {
    angle = NumberScanner(orient).number().value_or(0) * std::numbers::pi / 180;
  }
  const bool by_stroke = std::string_view(marker.attribute("markerUnits").value()) != "userSpaceOnUse";
  Eigen::Affine2d place = entered.context.to_part * Eigen::Translation2d(at) * Eigen::Rotation2Dd(angle);
  if (by_stroke) place = place * Eigen::Scaling(entered.style.pen.width);
  Eigen::Affine2d fit = Eigen::Affine2d::Identity();
  Box seen_box{{0, 0}, size};
  if (const auto view = view_box(marker.attribute("viewBox").value())) {
    fit = fitted(*view, size, marker.attribute("preserveAspectRatio").value());
    inner.context.viewport = view->size();
    seen_box = {fit.inverse() * Vec2(0, 0), fit.inverse() * size};
  }
  const auto reference = [&](const char* name, double from, double whole) {
    const std::string_view text = trimmed(marker.attribute(name).value());
    if (text == "left" || text == "top") return from;
    if (text == "center") return from + whole / 2;
    if (text == "right" || text == "bottom") return from + whole;
    return number(name, whole, 0);
  };
  const Vec2 pivot(reference("refX", seen_box.min.x(), seen_box.size().x()),
                   reference("refY", seen_box.min.y(), seen_box.size().y()));
  inner.context.to_part = place * Eigen::Translation2d(-(fit * pivot)) * fit;
  inner.context.depth = entered.context.depth + 1;
  if (inner.context.to_part.linear().determinant() == 0) return;
  if (!inner.style.overflow_visible) {
    narrow(inner.context, mapped_box(inner.context.to_part, seen_box));
  }
  const Opened opened(open_, marker);
  children(marker, inner.context);
}

}  // namespace unicursal::core
