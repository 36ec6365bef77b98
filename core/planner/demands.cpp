#include "core/planner/demands.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "core/field/make_direction_field.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/segment.hpp"

namespace unicursal::core {
namespace {

constexpr double fields_per_width = 4;    ///< squares of the direction field per bead width
constexpr std::size_t edges_tried = 100;  ///< of an anisotropic zone, for its direction
constexpr int angles_tried = 36;
constexpr double clearly_fewer = 1e-6;   ///< share of strand ends; smaller differences are rounding
constexpr double least_field = 0.1;      ///< a smaller ‖V‖ asks for no direction
constexpr double rewarded_angle = 0.55;  ///< angle to the field up to which a run is rewarded, rad
constexpr double crossing_cost =
    30;  ///< of a material's border (55), bead widths · rad²: more than all other costs
constexpr double samples_across = 1000;       ///< a piece, when its directions are summed up
constexpr double wholly = 0.9;                ///< least mean ‖V‖ of a piece that is aligned as a whole
constexpr double one_direction_share = 0.95;  ///< least ‖mean V‖ of a piece whose directions are all alike

/// An anisotropic zone may choose its direction (52): the one that needs the fewest turns.
std::vector<Zone> with_directions(std::vector<Zone> zones, const Island& island) {
  for (const ZoneRegion& region : island.zones) {
    Pattern& pattern = zones[region.zone].pattern;
    if (pattern.kind != PatternKind::anisotropic) continue;
    pattern.kind = PatternKind::angle;
    pattern.angle = direction_of_fewest_ends(region);
  }
  return zones;
}

bool asks_for_directions(const std::vector<Zone>& zones) {
  return std::any_of(zones.begin(), zones.end(), [](const Zone& zone) {
    return zone.pattern.kind != PatternKind::none && zone.pattern.kind != PatternKind::isotropic &&
           zone.pattern.kind != PatternKind::anisotropic;
  });
}

DirectionField field_of(const Island& island, const std::vector<Zone>& zones, const ZoneDirections& files,
                        double z, double bead_width) {
  if (!asks_for_directions(zones)) return {};
  return make_direction_field(island, zones, files, z, bead_width / fields_per_width);
}

bool any_anisotropic(const Island& island, const std::vector<Zone>& zones) {
  return std::any_of(island.zones.begin(), island.zones.end(), [&](const ZoneRegion& region) {
    return zones[region.zone].pattern.kind == PatternKind::anisotropic;
  });
}

bool several_materials(const Island& island, const std::vector<Zone>& zones) {
  return std::any_of(island.zones.begin(), island.zones.end(), [&](const ZoneRegion& region) {
    return zones[region.zone].material != zones[island.zones.front().zone].material;
  });
}

double squared_angle(const Vec2& u, const Vec2& v) {
  const double off = std::remainder(std::atan2(u.y(), u.x()) - direction(v), std::numbers::pi);
  return off * off;
}

}  // namespace

Demands::Demands(const Island& island, const std::vector<Zone>& zones, const ZoneDirections& files, double z,
                 double bead_width)
    : zones_(zones),
      bead_width_(bead_width),
      field_(field_of(island, with_directions(zones, island), files, z, bead_width)),
      map_(island, bead_width),
      several_materials_(several_materials(island, zones)) {
  if (any_anisotropic(island, zones)) named_field_ = field_of(island, zones, files, z, bead_width);
}

int Demands::material_borders(const Vec2& a, const Vec2& b) const {
  if (!several_materials_) return 0;
  return zones_[map_.zone_at(a)].material != zones_[map_.zone_at(b)].material ? 1 : 0;
}

RunCost Demands::first_run_cost() const {
  if (field_.empty() && !several_materials_) return {};
  return [this](const Vec2& a, const Vec2& b) {
    const Vec2 u = b - a;
    double cost = crossing_cost * bead_width_ * material_borders(a, b);
    const Vec2 asked = field_.empty() ? Vec2(0, 0) : field_.at((a + b) / 2);
    if (asked.norm() >= least_field && u.squaredNorm() > 0)
      cost += asked.norm() * u.norm() * (squared_angle(u, asked) - rewarded_angle * rewarded_angle);
    return cost;
  };
}

RunCost Demands::edge_cost(double weight) const {
  if (field_.empty() && !several_materials_) return {};
  return [this, weight](const Vec2& a, const Vec2& b) {
    double cost = crossing_cost * bead_width_ * material_borders(a, b);
    if (field_.empty() || a == b) return cost;
    const Vec2 asked = field_.quick_integral_around(a, b, bead_width_) / bead_width_;  // mm
    if (asked.norm() > 0) cost += weight * asked.norm() * squared_angle(b - a, asked);
    return cost;
  };
}

DemandAt Demands::at() const {
  return [this](const Vec2& p) {
    Demand demand;
    if (!field_.empty()) demand.direction = field_.at(p);
    const std::size_t zone = map_.zone_at(p);
    if (zones_[zone].pattern.kind == PatternKind::isotropic) demand.even_zone = EvenZoneIndex(zone);
    return demand;
  };
}

std::vector<OrientationZone> Demands::orientation_zones() const {
  std::vector<OrientationZone> result;
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    const PatternKind kind = zones_[z].pattern.kind;
    if (kind != PatternKind::isotropic && kind != PatternKind::anisotropic) continue;
    result.push_back(
        {[this, z](const Vec2& p) { return map_.zone_at(p) == z; }, kind == PatternKind::isotropic});
  }
  return result;
}

Vec2 Demands::mean_direction(const Polygon& piece, double& aligned_share) const {
  Vec2 sum(0, 0);
  double aligned = 0, total = 0;
  const Lattice lattice =
      sample(piece, std::max(bead_width_, bounds(piece).size().maxCoeff() / samples_across));
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) <= 0) continue;
    const Vec2 v = field_.at(lattice.position(k));
    sum += lattice.weight(k) * v;
    aligned += lattice.weight(k) * v.norm();
    total += lattice.weight(k);
  }
  aligned_share = aligned / total;
  return sum / total;
}

bool Demands::mostly_aligned(const Polygon& piece) const {
  if (field_.empty()) return false;
  double share = 0;
  mean_direction(piece, share);
  return share > 0.5;
}

bool Demands::wholly_aligned(const Polygon& piece) const {
  if (field_.empty()) return false;
  double share = 0;
  mean_direction(piece, share);
  return share > wholly;
}

bool Demands::partly_aligned(const Polygon& piece) const {
  if (field_.empty()) return false;
  double share = 0;
  mean_direction(piece, share);
  return share > 1 - wholly && share <= wholly;
}

std::optional<double> Demands::one_direction(const Polygon& piece) const {
  if (field_.empty()) return std::nullopt;
  double share = 0;
  const Vec2 mean = mean_direction(piece, share);
  if (!(mean.norm() > one_direction_share)) return std::nullopt;
  return direction(mean);
}

double direction_of_fewest_ends(const ZoneRegion& region) {
  std::vector<Segment> edges;
  for (const Polygon& polygon : region.polygons) {
    for (const Segment& edge : segments_of(polygon.outer)) edges.push_back(edge);
    for (const Ring& hole : polygon.holes) {
      for (const Segment& edge : segments_of(hole)) edges.push_back(edge);
    }
  }
  // The number of ends is least along some edge. The longest ones and some directions besides are tried.
  std::stable_sort(edges.begin(), edges.end(), [](const Segment& l, const Segment& r) {
    return (l.b - l.a).squaredNorm() > (r.b - r.a).squaredNorm();
  });
  std::vector<double> angles;
  for (std::size_t k = 0; k < std::min(edges.size(), edges_tried); ++k) {
    if (edges[k].a != edges[k].b) angles.push_back(direction(doubled(Vec2(edges[k].b - edges[k].a))));
  }
  for (int k = 0; k < angles_tried; ++k) angles.push_back(k * std::numbers::pi / angles_tried);
  double best = 0, fewest = std::numeric_limits<double>::infinity();
  for (const double angle : angles) {
    const Vec2 along(std::cos(angle), std::sin(angle));
    double ends = 0;
    for (const Segment& edge : edges) ends += std::abs(cross(along, edge.b - edge.a));
    if (ends < (1 - clearly_fewer) * fewest) best = angle, fewest = ends;
  }
  return best;
}

}  // namespace unicursal::core
