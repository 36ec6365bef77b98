#include "core/curve/resample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/curve/clearance.hpp"
#include "core/geometry/predicates.hpp"
#include "core/geometry/segment_grid.hpp"

namespace unicursal::core {
namespace {

constexpr double too_close = 0.5, too_far = 1.5;  ///< shares of the spacing
// A segment this short (share of the spacing) leaves its neighbours almost no clearance from each other, and
// would stay short for ever; the same holds for a hairpin whose strands are this near.
constexpr double collapsed = 0.1;
constexpr std::size_t fewest_vertices = 8;
constexpr int most_sweeps = 6;

/// Finds corners that may be cut off although clearances do not allow it. The curve stays simple and inside
/// if the corner's triangle holds no other vertex of curve or border, since anything that enters the triangle
/// has to end in it.
class Corners {
 public:
  Corners(const Curve& curve, const BorderIndex& border, double pitch)
      : curve_(curve), border_(border), pitch_(pitch) {}

  bool empty(std::size_t vertex) {
    const std::size_t before = curve_.before(vertex), after = curve_.after(vertex);
    const std::array<Vec2, 3> corner{curve_.vertices[before], curve_.vertices[vertex],
                                     curve_.vertices[after]};
    const Box box{corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
                  corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])};
    bool free = true;
    grid().near(box, [&](std::size_t i) {
      if (i != before && i != vertex && i != after) free = free && !holds(corner, curve_.vertices[i]);
    });
    border_.near(box, [&](std::size_t e) { free = free && !holds(corner, border_.edges()[e].a); });
    return free;
  }

 private:
  /// Built at the first question: most curves never ask.
  const SegmentGrid& grid() {
    if (!grid_) grid_.emplace(curve_.segments(), pitch_);
    return *grid_;
  }

  /// Whether the triangle holds the point. Exact; its sides count as inside, and so does their line if it is
  /// flat.
  static bool holds(const std::array<Vec2, 3>& corner, const Vec2& point) {
    const int a = orientation(corner[0], corner[1], point), b = orientation(corner[1], corner[2], point),
              c = orientation(corner[2], corner[0], point);
    return !((a > 0 || b > 0 || c > 0) && (a < 0 || b < 0 || c < 0));
  }

  const Curve& curve_;
  const BorderIndex& border_;
  double pitch_;
  std::optional<SegmentGrid> grid_;
};

/// One sweep. The neighbours of a removed vertex stay, so that every move is compared with its own clearance.
Curve thinned_once(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  const std::vector<double> free = freedom(curve, border, spacing, {}, workers);
  Curve result;
  Corners corners(curve, border, spacing);
  bool dropped = true;  // the first vertex stays
  std::size_t left = curve.size();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &before = curve.vertices[curve.before(i)], &here = curve.vertices[i];
    const Vec2& after = curve.vertices[curve.after(i)];
    const double nearest = std::min((here - before).norm(), (after - here).norm());
    const double apart = (after - before).norm();
    const bool movable = nearest < too_close * spacing && distance_to_segment(here, before, after) < free[i];
    const bool in_doubt =
        !dropped && i + 1 < curve.size() && left > fewest_vertices && apart < too_far * spacing;
    if (in_doubt && (movable || (std::min(nearest, apart) < collapsed * spacing && corners.empty(i)))) {
      dropped = true;
      --left;
      continue;
    }
    dropped = false;
    result.vertices.push_back(here);
  }
  return result;
}

}  // namespace

Curve thinned(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  Curve thin = curve;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::size_t size = thin.size();
    thin = thinned_once(thin, border, spacing, workers);
    if (thin.size() == size) break;
  }
  return thin;
}

Curve respaced(const Curve& curve, const BorderIndex& border, double spacing, Workers* workers) {
  const Curve thin = thinned(curve, border, spacing, workers);
  Curve result;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    const Vec2 &a = thin.vertices[i], &b = thin.vertices[thin.after(i)];
    const auto pieces = static_cast<int>(std::floor((b - a).norm() / (too_far * spacing))) + 1;
    for (int k = 0; k < pieces; ++k) result.vertices.push_back(a + static_cast<double>(k) / pieces * (b - a));
  }
  return result;
}

Curve subdivided(const Curve& curve) {
  Curve result;
  result.vertices.reserve(2 * curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    result.vertices.push_back(curve.vertices[i]);
    result.vertices.push_back((curve.vertices[i] + curve.vertices[curve.after(i)]) / 2);
  }
  return result;
}

}  // namespace unicursal::core
