#include "core/planner/measure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/curve/alignment.hpp"
#include "core/curve/evenness.hpp"
#include "core/curve/orientation.hpp"
#include "core/curve/shape_terms.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {
namespace {

constexpr double far = 1.2;        ///< bead widths; a point farther from the curve lies in a hole
constexpr double far_samples = 8;  ///< lattice squares per bead width for the search for holes

/// The segments within `reach` mm of a vertex along the curve, each with its length within reach.
std::vector<std::pair<std::size_t, double>> around(const Curve& curve, std::size_t vertex, double reach) {
  const auto length = [&](std::size_t i) {
    return (curve.vertices[curve.after(i)] - curve.vertices[i]).norm();
  };
  std::vector<std::pair<std::size_t, double>> found;
  double left = reach;
  for (std::size_t i = vertex, n = 0; left > 0 && n < curve.size() / 2; i = curve.after(i), ++n) {
    found.emplace_back(i, std::min(length(i), left));
    left -= length(i);
  }
  left = reach;
  for (std::size_t i = curve.before(vertex), n = 0; left > 0 && n < curve.size() / 2;
       i = curve.before(i), ++n) {
    found.emplace_back(i, std::min(length(i), left));
    left -= length(i);
  }
  return found;
}

}  // namespace

std::vector<double> segment_areas(const SegmentDiagram& diagram, const Curve& curve, double bead_width) {
  std::vector<double> areas(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    areas[i] += diagram.segments[i].area;
    const auto neighbours = around(curve, i, bead_width / 2);
    double total = 0;
    for (const auto& [segment, length] : neighbours) total += length;
    for (const auto& [segment, length] : neighbours)
      areas[segment] += length / total * diagram.points[i].area;
  }
  return areas;
}

CurveObjectives objectives(const SegmentDiagram& diagram, const Curve& curve, double region_area,
                           double bead_width, const DirectionField& field) {
  CurveObjectives result;
  for (const auto* cells : {&diagram.points, &diagram.segments}) {
    for (const CellIntegrals& cell : *cells) result.coverage += cell.second_moment;
  }
  const double length = curve.length(), width = region_area / length, target = region_area / bead_width;
  result.normalised_coverage = result.coverage / (region_area * width * width);
  result.length = (length - target) * (length - target);
  result.smoothness = smoothness(curve);
  result.alignment = mean_squared_angle(curve, field);
  return result;
}

void measure_path(const BeadPath& path, const std::vector<Zone>& zones, double bead_width,
                  CurveObjectives& result) {
  std::vector<std::vector<Stroke>> strokes(zones.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 u = path.end(i) - path.start(i);
    strokes[path.beads[i].zone].push_back({std::atan2(u.y(), u.x()), u.norm()});
  }
  constexpr double most = std::numbers::pi * std::numbers::pi / 12;
  for (std::size_t z = 0; z < zones.size(); ++z) {
    if (strokes[z].empty()) continue;
    const double distance = isotropy_distance(std::move(strokes[z]));
    const PatternKind kind = zones[z].pattern.kind;
    if (kind == PatternKind::isotropic) result.isotropy = std::max(result.isotropy, distance);
    if (kind == PatternKind::anisotropic) result.anisotropy = std::max(result.anisotropy, most - distance);
  }
  result.width_variation = width_variation(path, bead_width);
}

Holes look_for_holes(const Curve& curve, const Polygon& region, double bead_width, Workers* workers) {
  const double w = bead_width;
  const std::vector<Segment> segments = curve.segments();
  Holes holes;
  for (const Polygon& piece : opened({region}, w / 2, 0.005 * w)) {
    const double extent = bounds(piece).size().maxCoeff();
    const Lattice lattice = sample(piece, std::max(w / far_samples, extent / 30000));
    LatticeOwners owners(lattice, {0, false, workers});
    owners.assign(segments);
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      if (lattice.weight(k) <= 0 || owners.owner(k) < 0) continue;
      const double distance = std::sqrt(owners.distance2(k));
      holes.farthest = std::max(holes.farthest, distance);
      if (distance > far * w) holes.area += lattice.weight(k);
    }
  }
  return holes;
}

}  // namespace unicursal::core
