// Random islands; each kind is difficult in its own way. Lengths in mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/support/shapes.hpp"

namespace unicursal::core::test {

inline Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

inline double random_turn(Random& random) {
  return random.uniform(0, 2 * std::numbers::pi);
}

/// A random number whose logarithm is uniform.
inline double random_scale(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

inline Polygon largest_of(const Region& region) {
  return *std::max_element(region.begin(), region.end(),
                           [](const Polygon& a, const Polygon& b) { return area(a) < area(b); });
}

/// Bars of any width down to the clipping grid, added to the island or cut from it.
inline Region with_slivers(Region region, Random& random, double radius) {
  for (std::size_t k = 1 + random.below(6); k > 0; --k) {
    const Vec2 u = unit(random_turn(random)), n = perpendicular(u);
    const Vec2 middle = radius * random.uniform(0, 1.2) * unit(random_turn(random));
    const Vec2 half = radius * random.uniform(0.1, 1.3) * u;
    const Vec2 side = random_scale(random, 1e-6, 0.4) * n;
    const Region bar = enclosed({{middle - half, middle + half, middle + half + side, middle - half + side}},
                                FillRule::non_zero);
    Region changed = random.below(2) == 0 ? unite(region, bar) : subtract(region, bar);
    if (!changed.empty()) region = std::move(changed);
  }
  return region;
}

/// Triangles with tips as sharp as the grid allows, pointing outwards and inwards.
inline Region with_spikes(Region region, Random& random, double radius) {
  for (std::size_t k = 1 + random.below(8); k > 0; --k) {
    const double turn = random_turn(random);
    const Vec2 foot = radius * random.uniform(0.1, 0.9) * unit(turn);
    const Vec2 tip = foot + radius * random.uniform(-1.5, 1.5) * unit(turn + random.uniform(-0.5, 0.5));
    const Vec2 side = random_scale(random, 1e-6, 0.5) * perpendicular(unit(turn));
    const Region spike = enclosed({{foot - side, tip, foot + side}}, FillRule::non_zero);
    Region changed = random.below(3) == 0 ? subtract(region, spike) : unite(region, spike);
    if (!changed.empty()) region = std::move(changed);
  }
  return region;
}

/// Holes that are only 1e-6 mm from one another or from the border, or just touch.
inline Region with_close_holes(Region region, Random& random, double radius) {
  Vec2 center = radius * random.uniform(0, 0.6) * unit(random_turn(random));
  double r = radius * random.uniform(0.02, 0.25);
  for (std::size_t k = 2 + random.below(8); k > 0; --k) {
    const Region hole =
        enclosed({circle(center, r, 3 + static_cast<int>(random.below(40)))}, FillRule::non_zero);
    Region changed = subtract(region, hole);
    if (!changed.empty()) region = std::move(changed);
    const double next = radius * random.uniform(0.02, 0.25);
    const double gap = random.below(4) == 0 ? 0.0 : random_scale(random, 1e-6, 0.3);
    center += (r + next + gap) * unit(random_turn(random));
    r = next;
  }
  return region;
}

/// A comb: teeth and gaps of any width.
inline Region comb(Random& random, double radius) {
  std::vector<Ring> rings{
      {{-radius, -radius}, {radius, -radius}, {radius, -0.8 * radius}, {-radius, -0.8 * radius}}};
  for (double x = -radius; x < radius;) {
    const double tooth = random_scale(random, 0.02, 1.5), top = radius * random.uniform(-0.7, 1);
    rings.push_back({{x, -0.9 * radius}, {x + tooth, -0.9 * radius}, {x + tooth, top}, {x, top}});
    x += tooth + random_scale(random, 1e-3, 1.5);
  }
  return enclosed(rings, FillRule::non_zero);
}

/// An outline of thousands of vertices, smooth or as rough as noise.
inline Polygon many_vertices(Random& random, double radius) {
  Ring outer;
  const int sides = 1000 + static_cast<int>(random.below(4001));
  const double noise = random_scale(random, 1e-6, 0.1), waves = std::floor(random.uniform(0, 9));
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * k / sides;
    outer.push_back(radius * (1 + 0.3 * std::sin(waves * turn) + noise * random.uniform(-1, 1)) * unit(turn));
  }
  return {outer, {}};
}

/// Additional vertices as little as 1e-9 mm from others, and on straight edges.
inline Ring with_tiny_edges(const Ring& ring, Random& random) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double length = (b - a).norm();
    result.push_back(a);
    if (length < 1e-3 || random.below(2) == 0) continue;
    result.push_back(a + random_scale(random, 1e-9, 1e-4) / length * (b - a));
    if (random.below(2) == 0) result.push_back(a + random.uniform(0.2, 0.8) * (b - a));
    if (random.below(2) == 0) result.push_back(b - 1e-9 / length * (b - a));
  }
  return result;
}

constexpr int island_kinds = 7;

/// An island of the given kind (0 … island_kinds − 1), about `radius` mm in size.
inline Polygon random_island_of_kind(Random& random, int kind, double radius) {
  const Polygon plain = random_island(random, radius, 5);
  switch (kind) {
    case 0:
      return plain;
    case 1:
      return largest_of(with_slivers({plain}, random, radius));
    case 2:
      return largest_of(with_spikes({plain}, random, radius));
    case 3:
      return largest_of(with_close_holes({plain}, random, radius));
    case 4:
      return largest_of(comb(random, radius));
    case 5:
      return many_vertices(random, radius);
    default: {
      Polygon tiny = plain;
      tiny.outer = with_tiny_edges(tiny.outer, random);
      for (Ring& hole : tiny.holes) hole = with_tiny_edges(hole, random);
      return tiny;
    }
  }
}

/// Zones of the outline, cut by up to four random bars and discs.
inline Island random_zones(Random& random, const Polygon& outline) {
  const Box box = bounds(outline);
  const double size = box.size().norm() / 2;
  Region rest{outline};
  Island island{outline, {}};
  for (std::size_t zone = 0, cuts = 1 + random.below(4); zone < cuts && !rest.empty(); ++zone) {
    const Vec2 center = box.center() + size * random.uniform(0, 0.8) * unit(random_turn(random));
    const double r = size * random_scale(random, 0.01, 0.8);
    const Vec2 u = 3 * size * unit(random_turn(random)), n = r / size * perpendicular(u) / 3;
    const Ring shape = random.below(2) == 0
                           ? circle(center, r, 3 + static_cast<int>(random.below(40)))
                           : Ring{center - u - n, center + u - n, center + u + n, center - u + n};
    const Region cutter = enclosed({shape}, FillRule::non_zero);
    Region part = intersect(rest, cutter);
    rest = subtract(rest, cutter);
    if (!part.empty()) island.zones.push_back({zone, std::move(part)});
  }
  if (!rest.empty()) island.zones.push_back({4, std::move(rest)});
  return island;
}

/// Five zones of random patterns and up to three materials; `file` is a file of directions.
inline std::vector<Zone> random_patterns(Random& random, const std::filesystem::path& file) {
  std::vector<Zone> zones(5);
  for (Zone& zone : zones) {
    zone.pattern.kind = static_cast<PatternKind>(random.below(7));
    zone.pattern.angle = random.uniform(-4, 4);
    zone.pattern.field = file;
    zone.pattern.along_zone_border = random.below(2) == 0;
    zone.material = random.below(3);
  }
  return zones;
}

}  // namespace unicursal::core::test
