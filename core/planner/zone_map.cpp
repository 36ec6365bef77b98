#include "core/planner/zone_map.hpp"

#include <algorithm>
#include <limits>

namespace unicursal::core {

ZoneMap::ZoneMap(const Island& island, double pitch) {
  for (const ZoneRegion& region : island.zones) {
    for (const Polygon& polygon : region.polygons)
      pieces_.push_back({region.zone, polygon, BorderIndex(polygon, pitch)});
  }
}

std::vector<double> ZoneMap::crossings(const Vec2& a, const Vec2& b) const {
  std::vector<double> found;
  for (const Piece& piece : pieces_) {
    piece.border.near({a.cwiseMin(b), a.cwiseMax(b)}, [&](std::size_t e) {
      const BorderEdge& edge = piece.border.edges()[e];
      const double slope = cross(b - a, edge.b - edge.a);
      if (slope == 0) return;
      const double s = cross(edge.a - a, edge.b - edge.a) / slope, t = cross(edge.a - a, b - a) / slope;
      if (s > 0 && s < 1 && t >= 0 && t <= 1) found.push_back(s);
    });
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::size_t ZoneMap::zone_at(const Vec2& p) const {
  if (pieces_.size() == 1) return pieces_.front().zone;
  for (const Piece& piece : pieces_) {
    if (piece.border.contains(p)) return piece.zone;
  }
  double best = std::numeric_limits<double>::infinity();
  std::size_t zone = pieces_.front().zone;
  for (const Piece& piece : pieces_) {
    const double d = distance_to_border(piece.polygon, p);
    if (d < best) best = d, zone = piece.zone;
  }
  return zone;
}

}  // namespace unicursal::core
