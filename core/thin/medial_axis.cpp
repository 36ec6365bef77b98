#include "core/thin/medial_axis.hpp"

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/geometry/border_index.hpp"
#include "core/geometry/region.hpp"
#include "core/geometry/segment.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double most_grid = 1e6;           ///< grid steps per mm, that of region.hpp, for parts below 1 m
constexpr double most_steps = 1e9;          ///< of the grid along an axis: Boost.Polygon works on 32 bits
constexpr double inset = 2e-3;              ///< steps; how far inside the border the diagram is built
constexpr std::size_t most_pieces = 10000;  ///< of one edge of the diagram

using Point = boost::polygon::point_data<std::int32_t>;
using GridSegment = boost::polygon::segment_data<std::int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

class AxisBuilder {
 public:
  AxisBuilder(const Polygon& polygon, double step)
      : step_(step), border_(polygon, 4 * step), centre_(bounds(polygon).center()) {
    grid_ = std::min(most_grid, most_steps / (bounds(polygon).size().maxCoeff() + 1));
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }

  MedialAxis build() {
    stop_point();
    boost::polygon::construct_voronoi(segments_.begin(), segments_.end(), &diagram_);
    for (const Diagram::edge_type& edge : diagram_.edges()) {
      const bool once = &edge < edge.twin();
      if (once && edge.is_primary() && edge.is_finite()) add(edge);
    }
    return std::move(axis_);
  }

 private:
  void add(const Ring& ring) {
    const auto rounded = [&](const Vec2& p) {
      const Vec2 q = (p - centre_) * grid_;
      return Point(static_cast<std::int32_t>(std::lround(q.x())),
                   static_cast<std::int32_t>(std::lround(q.y())));
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = rounded(ring[i]), b = rounded(ring[i + 1 < ring.size() ? i + 1 : 0]);
      if (a != b) segments_.emplace_back(a, b);
    }
  }

  Vec2 place(const Point& p) const { return Vec2(p.x(), p.y()) / grid_ + centre_; }
  Vec2 place(const Diagram::vertex_type& v) const { return Vec2(v.x(), v.y()) / grid_ + centre_; }

  Segment segment(const Diagram::cell_type& cell) const {
    const GridSegment& s = segments_[cell.source_index()];
    return {place(s.low()), place(s.high())};
  }
  /// The point of a cell that belongs to a corner.
  std::optional<Vec2> corner(const Diagram::cell_type& cell) const {
    if (!cell.contains_point()) return std::nullopt;
    const GridSegment& s = segments_[cell.source_index()];
    const bool start = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT;
    return place(start ? s.low() : s.high());
  }

  double distance(const Diagram::cell_type& cell, const Vec2& p) const {
    if (const std::optional<Vec2> point = corner(cell)) return (p - *point).norm();
    const Segment s = segment(cell);
    return distance_to_segment(p, s.a, s.b);
  }

  /// The point of an edge between a corner and a segment (a parabola) whose foot on the segment is `foot`.
  static Vec2 on_parabola(const Vec2& focus, const Vec2& foot, const Vec2& normal) {
    const Vec2 off = focus - foot;
    const double height = off.dot(normal);
    return height != 0 ? Vec2(foot + off.squaredNorm() / (2 * height) * normal) : foot;
  }

  std::vector<Vec2> points(const Diagram::edge_type& edge) const {
    const Vec2 from = place(*edge.vertex0()), to = place(*edge.vertex1());
    const Diagram::cell_type *one = edge.cell(), *other = edge.twin()->cell();
    if (!one->contains_point()) std::swap(one, other);
    const auto pieces = static_cast<std::size_t>(std::ceil((to - from).norm() / step_));
    const std::size_t count = std::clamp<std::size_t>(edge.is_curved() ? 2 * pieces : pieces, 1, most_pieces);
    std::vector<Vec2> result{from};
    for (std::size_t k = 1; k < count; ++k) {
      Vec2 p = from + static_cast<double>(k) / static_cast<double>(count) * (to - from);
      if (edge.is_curved()) {
        const Segment line = segment(*other);
        const Vec2 along = (line.b - line.a).normalized();
        p = on_parabola(*corner(*one), line.a + along.dot(p - line.a) * along, perpendicular(along));
      }
      result.push_back(p);
    }
    result.push_back(to);
    return result;
  }

  std::size_t node_at(const Diagram::vertex_type& vertex, double radius) {
    const auto v = static_cast<std::size_t>(&vertex - diagram_.vertices().data());
    if (node_.empty()) node_.assign(diagram_.num_vertices(), unknown);
    if (node_[v] == unknown) {
      node_[v] = axis_.size();
      axis_.push_back({place(vertex), radius, {}});
    }
    return node_[v];
  }

  void add(const Diagram::edge_type& edge) {
    const std::vector<Vec2> line = points(edge);
    const std::size_t middle = line.size() / 2;
    if (!border_.contains((line[middle - 1] + line[middle]) / 2)) return;
    std::size_t last = node_at(*edge.vertex0(), distance(*edge.cell(), line.front()));
    for (std::size_t k = 1; k < line.size(); ++k) {
      const double radius = distance(*edge.cell(), line[k]);
      std::size_t here = axis_.size();
      if (k + 1 == line.size()) {
        here = node_at(*edge.vertex1(), radius);
      } else {
        axis_.push_back({line[k], radius, {}});
      }
      if (here == last) continue;
      axis_[last].next.push_back(here);
      axis_[here].next.push_back(last);
      last = here;
    }
  }

  static constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();

  double step_;
  BorderIndex border_;
  Vec2 centre_;
  double grid_ = most_grid;
  std::vector<GridSegment> segments_;
  Diagram diagram_;
  std::vector<std::size_t> node_;  ///< of each vertex of the diagram
  MedialAxis axis_;
};

}  // namespace

MedialAxis medial_axis(const Polygon& polygon, double step) {
  // Rings may touch in points, which the diagram does not allow; a little inside the border they do not.
  const double aside = inset * step;
  MedialAxis all;
  for (const Polygon& piece : offset({polygon}, -aside, aside / 10)) {
    const std::size_t first = all.size();
    for (AxisNode& node : AxisBuilder(piece, step).build()) {
      node.radius += aside;
      for (std::size_t& next : node.next) next += first;
      all.push_back(std::move(node));
    }
  }
  return all;
}

}  // namespace unicursal::core
