#include "core/planner/zones_along.hpp"

#include <algorithm>
#include <cmath>

#include "core/planner/zone_map.hpp"

namespace unicursal::core {
namespace {

constexpr double least_piece = 1e-3;  ///< mm; a shorter piece is not cut off its neighbour

}  // namespace

BeadPath along_zones(const Curve& curve, const std::vector<double>& areas, const Island& island) {
  BeadPath path;
  if (island.zones.size() == 1) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
      path.beads.push_back({curve.vertices[i], areas[i], island.zones.front().zone});
    }
    return path;
  }
  const ZoneMap map(island, curve.length() / static_cast<double>(curve.size()));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &a = curve.vertices[i], &b = curve.vertices[curve.after(i)];
    const double length = (b - a).norm();
    double from = 0;
    std::vector<double> cuts = map.crossings(a, b);
    cuts.push_back(1);
    std::size_t last_zone = 0;
    bool open = false;  // a bead of this segment has been started
    for (const double cut : cuts) {
      if (cut < 1 && ((cut - from) * length < least_piece || (1 - cut) * length < least_piece)) continue;
      const std::size_t zone = map.zone_at(a + (from + cut) / 2 * (b - a));
      if (open && zone == last_zone) {
        path.beads.back().area += (cut - from) * areas[i];
      } else {
        path.beads.push_back({a + from * (b - a), (cut - from) * areas[i], zone});
      }
      open = true;
      last_zone = zone;
      from = cut;
    }
  }
  return path;
}

std::size_t material_changes(const BeadPath& path, const std::vector<Zone>& zones) {
  std::size_t changes = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t next = i + 1 < path.size() ? i + 1 : 0;
    if (zones[path.beads[i].zone].material != zones[path.beads[next].zone].material) ++changes;
  }
  return changes;
}

}  // namespace unicursal::core
