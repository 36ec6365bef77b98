#include "core/geometry/cell_walk.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/geometry/border_index.hpp"
#include "core/geometry/diagram_arc.hpp"

namespace unicursal::core {
namespace {

// The diagram is taken to lie this far beside the border, mm: beyond rounding, but without effect on areas.
constexpr double off_lines = 1e-11;

class CellWalk {
 public:
  CellWalk(const CurveSites& sites, const Frame& frame, const Polygon& piece, CellSums& cells)
      : sites_(sites),
        frame_(frame),
        border_(piece, sites.pitch()),
        cuts_(border_.edges().size()),
        cells_(cells) {}

  /// Adds both cells' share of the border between them, clipped by the piece.
  void add_arc(const CellBorder& between) {
    const auto& [left, right, from, to] = between;
    if (from == to) return;
    const Arc arc = arc_between(left, right, from, to);
    std::vector<double> cuts{0, 1};
    std::vector<std::size_t> near;
    border_.near(bounds(arc), [&](std::size_t e) { near.push_back(e); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t e : near) {
      const BorderEdge& edge = border_.edges()[e];
      for (const double s : crossings(arc, edge.a, edge.b)) {
        cuts.push_back(s);
        cut_border(e, arc.at(s));
      }
      // Whether an end reaches the border depends on rounding, and not alike for edges that coincide.
      for (const Vec2& end : {arc.from, arc.to}) {
        if (distance_to_segment(end, edge.a, edge.b) < rounding_slack) cut_border(e, end);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const int winding = border_.winding(arc.at((cuts[k] + cuts[k + 1]) / 2) + aside());
      if (winding == 0) continue;
      note_ends(left, arc, cuts[k], cuts[k + 1]);
      cells_.add(left, arc, cuts[k], cuts[k + 1], winding);
      cells_.add(right, arc, cuts[k], cuts[k + 1], -winding);
    }
  }

  /// Adds the border of the piece, each stretch to the cell in which it lies. To be called after all arcs.
  void add_border() {
    for (std::size_t e = 0; e < cuts_.size(); ++e) {
      const BorderEdge& edge = border_.edges()[e];
      if (edge.a == edge.b) continue;
      const bool cut_off = frame_.on_line(edge.a, edge.b);
      std::vector<double>& cuts = cuts_[e];
      if (cut_off) add_corners(edge, cuts);
      cuts.push_back(0);
      cuts.push_back(1);
      std::sort(cuts.begin(), cuts.end());
      const Arc arc = line(edge.a, edge.b);
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        if (cuts[k + 1] <= cuts[k]) continue;
        const Vec2 middle = arc.at((cuts[k] + cuts[k + 1]) / 2);
        // Along the lines between pieces, edges outside the island run back and forth.
        if (cut_off && frame_.island->winding(middle) == 0) continue;
        const CurveSite site = sites_.nearest(middle - aside());
        note_ends(site, arc, cuts[k], cuts[k + 1]);
        if (cells_.has(site)) cells_.add(site, arc, cuts[k], cuts[k + 1], 1);
      }
    }
  }

  double missing() const { return missing_; }

 private:
  Arc arc_between(const CurveSite& l, const CurveSite& r, const Vec2& from, const Vec2& to) const {
    if (l.segment == r.segment) return line(from, to);
    const CurveSite& point = l.segment ? r : l;
    const CurveSite& segment = l.segment ? l : r;
    if (sites_.ends_in(segment.index, point.index)) return line(from, to);
    return parabola(from, to, sites_.curve()[point.index], sites_.segment(segment.index).a,
                    sites_.direction(segment.index));
  }

  /// Where cells' borders run along the island's border, all of them must fall on the same side of it: so the
  /// whole diagram is taken to lie a little beside it.
  static Vec2 aside() { return off_lines * Vec2(0.8090169943749475, 0.5877852522924731); }

  /// Notes that a cell's border meets edge `e` at `p`; a second note of the same point does no harm.
  void cut_border(std::size_t e, const Vec2& p) {
    const BorderEdge& edge = border_.edges()[e];
    const Vec2 along = edge.b - edge.a;
    cuts_[e].push_back(std::clamp((p - edge.a).dot(along) / along.squaredNorm(), 0.0, 1.0));
  }

  /// Adds cuts where other edges meet one that runs along a line between pieces.
  void add_corners(const BorderEdge& edge, std::vector<double>& cuts) const {
    for (const BorderEdge& other : border_.edges()) {
      if (!frame_.on_line(edge.a, edge.b, other.a)) continue;
      const double s = (other.a - edge.a).dot(edge.b - edge.a) / (edge.b - edge.a).squaredNorm();
      if (s > 0 && s < 1) cuts.push_back(s);
    }
  }

  /// Updates how far the search fell short. The shortfall is a convex function of the point within each cell,
  /// so it is greatest at the ends of the stretches of the cell's border.
  void note_ends(const CurveSite& site, const Arc& arc, double s0, double s1) {
    for (const double s : {s0, s1}) {
      const Vec2 p = arc.at(s);
      const double inside =
          std::min((p - frame_.searched.min).minCoeff(), (frame_.searched.max - p).minCoeff());
      missing_ = std::max(missing_, (sites_.nearest_point(site, p) - p).norm() - inside);
    }
  }

  const CurveSites& sites_;
  const Frame& frame_;
  BorderIndex border_;
  std::vector<std::vector<double>> cuts_;  ///< per edge of the piece's border, where cells' borders meet it
  CellSums& cells_;
  double missing_ = 0;
};

}  // namespace

double walk_cells(const CurveSites& sites, const std::vector<CellBorder>& borders, const Frame& frame,
                  const Polygon& piece, CellSums& cells) {
  CellWalk walk(sites, frame, piece, cells);
  for (const CellBorder& border : borders) walk.add_arc(border);
  walk.add_border();
  return walk.missing();
}

}  // namespace unicursal::core
