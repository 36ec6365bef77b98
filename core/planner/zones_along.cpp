#include "core/planner/zones_along.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/border_index.hpp"

namespace unicursal::core {
namespace {

constexpr double least_piece = 1e-3;  ///< mm; a shorter piece stays with its neighbour

class ZoneMap {
 public:
  ZoneMap(const Island& island, double pitch) {
    for (const ZoneRegion& region : island.zones) {
      for (const Polygon& polygon : region.polygons)
        pieces_.push_back({region.zone, polygon, BorderIndex(polygon, pitch)});
    }
  }

  /// Parameters in (0, 1) where the segment meets a zone's border, ascending.
  std::vector<double> crossings(const Vec2& a, const Vec2& b) const {
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

  /// The zone at a point; between zones (welded borders are exact to 0.01 mm only) the nearest one's.
  std::size_t zone_at(const Vec2& p) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t zone = pieces_.front().zone;
    for (const Piece& piece : pieces_) {
      if (piece.border.contains(p)) return piece.zone;
    }
    for (const Piece& piece : pieces_) {
      const double d = distance_to_border(piece.polygon, p);
      if (d < best) best = d, zone = piece.zone;
    }
    return zone;
  }

 private:
  struct Piece {
    std::size_t zone;
    Polygon polygon;
    BorderIndex border;
  };
  std::vector<Piece> pieces_;
};

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
