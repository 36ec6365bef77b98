// Which zone of an island a point lies in. mm.
#pragma once

#include <vector>

#include "core/geometry/border_index.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

class ZoneMap {
 public:
  /// `pitch` mm: about the length of the segments that crossings() will be asked for.
  ZoneMap(const Island& island, double pitch);

  /// Parameters in (0, 1) where the segment meets a zone's border, ascending.
  std::vector<double> crossings(const Vec2& a, const Vec2& b) const;

  /// The zone at a point, as an index into Part::zones(). If the point lies in no zone (borders are welded to
  /// within 0.01 mm only), the nearest zone.
  std::size_t zone_at(const Vec2& p) const;

 private:
  struct Piece {
    std::size_t zone;
    Polygon polygon;
    BorderIndex border;
  };
  std::vector<Piece> pieces_;
};

}  // namespace unicursal::core
