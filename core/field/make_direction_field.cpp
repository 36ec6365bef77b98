#include "core/field/make_direction_field.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "core/field/border_extension.hpp"
#include "core/field/grid_cover.hpp"

namespace unicursal::core {
namespace {

constexpr double least_share = 1e-9;  ///< of a square; a smaller cover is rounding

bool asks_for_direction(PatternKind kind) {
  return kind != PatternKind::none && kind != PatternKind::isotropic && kind != PatternKind::anisotropic;
}

/// V per square for each zone of an island. The extension of the island's border is computed only once.
class ZoneVectors {
 public:
  ZoneVectors(const Grid& grid, const Island& island, const ZoneDirections& files, double z)
      : grid_(grid), island_(island), files_(files), z_(z) {}

  std::vector<Vec2> of(const ZoneRegion& region, const Pattern& pattern, const std::vector<double>& share) {
    switch (pattern.kind) {
      case PatternKind::angle:
        return std::vector<Vec2>(grid_.size(), doubled(pattern.angle));
      case PatternKind::parallel:
        return tangents(region, pattern.along_zone_border);
      case PatternKind::orthogonal: {
        std::vector<Vec2> result = tangents(region, pattern.along_zone_border);
        for (Vec2& v : result) v = -v;  // a right angle, doubled
        return result;
      }
      case PatternKind::field:
        return files_[region.zone]->on_grid(grid_, share, z_);
      default:
        return std::vector<Vec2>(grid_.size(), Vec2(0, 0));
    }
  }

 private:
  std::vector<Vec2> tangents(const ZoneRegion& region, bool along_zone_border) {
    if (along_zone_border) return extended_tangents(grid_, region.polygons);
    if (of_island_.empty()) of_island_ = extended_tangents(grid_, {island_.outline});
    return of_island_;
  }

  const Grid& grid_;
  const Island& island_;
  const ZoneDirections& files_;
  double z_;
  std::vector<Vec2> of_island_;
};

}  // namespace

ZoneDirections read_zone_directions(const std::vector<Zone>& zones) {
  std::map<std::filesystem::path, std::shared_ptr<const ScatteredDirections>> known;
  ZoneDirections result(zones.size());
  for (std::size_t k = 0; k < zones.size(); ++k) {
    if (zones[k].pattern.kind != PatternKind::field) continue;
    auto& samples = known[zones[k].pattern.field];
    if (!samples) samples = std::make_shared<ScatteredDirections>(read_directions(zones[k].pattern.field));
    result[k] = samples;
  }
  return result;
}

DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones,
                                    const ZoneDirections& files, double z, double pitch) {
  assert(pitch > 0 && files.size() == zones.size());
  const auto pattern_of = [&](const ZoneRegion& region) -> const Pattern& {
    return zones[region.zone].pattern;
  };
  if (std::none_of(island.zones.begin(), island.zones.end(),
                   [&](const ZoneRegion& r) { return asks_for_direction(pattern_of(r).kind); })) {
    return {};
  }
  const Grid grid = grid_around(bounds(island.outline), pitch);
  ZoneVectors vectors(grid, island, files, z);
  std::vector<Vec2> sum(grid.size(), Vec2(0, 0));
  std::vector<double> share(grid.size());
  for (const ZoneRegion& region : island.zones) {
    const std::vector<double> covered = cover(grid, region.polygons);
    for (std::size_t k = 0; k < grid.size(); ++k) share[k] += covered[k];
    if (!asks_for_direction(pattern_of(region).kind)) continue;
    const std::vector<Vec2> v = vectors.of(region, pattern_of(region), covered);
    for (std::size_t k = 0; k < grid.size(); ++k) sum[k] += covered[k] * v[k];
  }
  for (std::size_t k = 0; k < grid.size(); ++k) {
    sum[k] = share[k] > least_share ? Vec2(sum[k] / share[k]) : Vec2(0, 0);
  }
  return {grid, std::move(sum), share};
}

DirectionField make_direction_field(const Island& island, const std::vector<Zone>& zones, double pitch) {
  return make_direction_field(island, zones, read_zone_directions(zones), 0, pitch);
}

}  // namespace unicursal::core
