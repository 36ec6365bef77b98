// The skeleton of a leaf as a plate: a rim, a midrib, side veins and cross veins; the lamina between them is
// cut out. 146 × 160 mm, about 60 holes, branches down to 2 mm. It is the same in every run. mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/region.hpp"

namespace unicursal::bench {

using core::Polygon;
using core::Region;
using core::Ring;
using core::Vec2;

inline constexpr double leaf_width = 146, leaf_height = 160;
inline constexpr double stalk = 22;                       ///< below the blade
inline constexpr double rim = 3, thinnest = 2;            ///< widths of branches
inline constexpr double midrib_foot = 8, midrib_tip = 3;  ///< widths of the midrib
inline constexpr double side_foot = 4.2;                  ///< width of a side vein where it leaves the midrib
inline constexpr int side_veins = 7;                      ///< on either side
inline constexpr double rise = 0.62;                      ///< of a side vein, mm upwards for each mm outwards
inline constexpr double between_cross_veins = 13;         ///< along a side vein
inline constexpr double fillet = 0.8;                     ///< radius in the corners between branches
inline constexpr double arcs = 0.01;                      ///< tolerance of rounded corners
inline constexpr double least_hole = 4;                   ///< mm²; smaller ones are filled in

/// A branch whose width falls linearly from its foot to its tip.
inline void add_branch(std::vector<Ring>& rings, const std::vector<Vec2>& line, double foot, double tip) {
  const auto width = [&](std::size_t i) {
    return foot + (tip - foot) * static_cast<double>(i) / static_cast<double>(line.size() - 1);
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    Ring joint;
    for (int k = 0; k < 24; ++k) {
      const double turn = 2 * std::numbers::pi * k / 24;
      joint.push_back(line[i] + width(i) / 2 * Vec2(std::cos(turn), std::sin(turn)));
    }
    rings.push_back(joint);
    if (i + 1 == line.size()) break;
    const Vec2 across = core::perpendicular(line[i + 1] - line[i]).normalized();
    rings.push_back({line[i] - width(i) / 2 * across, line[i + 1] - width(i + 1) / 2 * across,
                     line[i + 1] + width(i + 1) / 2 * across, line[i] + width(i) / 2 * across});
  }
}

/// Half the width of the blade at height y.
inline double blade_half_width(double y) {
  const double t = std::clamp((y - stalk) / (leaf_height - stalk), 0.0, 1.0);
  return leaf_width / 2 * std::pow(std::sin(std::numbers::pi * std::pow(t, 0.75)), 0.85);
}

inline Polygon blade() {
  Ring right, left;
  constexpr int steps = 200;
  for (int k = 0; k <= steps; ++k) {
    // The points lie closer together towards foot and tip, where the outline is round.
    const double t = (1 - std::cos(std::numbers::pi * k / steps)) / 2;
    const double y = stalk + t * (leaf_height - stalk), x = blade_half_width(y);
    right.emplace_back(x, y);
    if (k > 0 && k < steps) left.emplace_back(-x, y);
  }
  std::reverse(left.begin(), left.end());
  right.insert(right.end(), left.begin(), left.end());
  return {right, {}};
}

/// The point of the side vein `k` that is `x` mm from the midrib; side = ±1.
inline Vec2 on_side_vein(double k, double x, int side) {
  const double foot = stalk + 4 + k * (leaf_height - stalk - 30) / side_veins;
  return {side * x, foot + rise * x + 0.002 * x * x};
}

/// A cross vein from one side vein to the next; slightly oblique, as in a real leaf.
inline void add_cross_veins(std::vector<Ring>& rings, int k, int side) {
  for (int j = 1; j < 6; ++j) {
    const double x = between_cross_veins * (j + (k % 2 == 0 ? 0.0 : 0.45));
    const Vec2 from = on_side_vein(k, x, side), to = on_side_vein(k + 1, x - 2.5, side);
    if (std::abs(to.x()) > blade_half_width(to.y())) break;
    add_branch(rings, {from, (from + to) / 2 + Vec2(side * 1.2, 0), to}, thinnest, thinnest);
  }
}

inline Polygon leaf_plate() {
  std::vector<Ring> veins;
  add_branch(veins, {{0, midrib_foot / 2}, {0, leaf_height / 2}, {0, leaf_height - 2}}, midrib_foot,
             midrib_tip);
  for (const int side : {-1, 1}) {
    for (int k = 0; k < side_veins; ++k) {
      std::vector<Vec2> line;
      for (double x = 0; x <= leaf_width / 2; x += 6) line.push_back(on_side_vein(k, x, side));
      add_branch(veins, line, side_foot, thinnest);
      add_cross_veins(veins, k, side);
    }
    add_cross_veins(veins, -1, side);  // from the rim to the lowest side vein
  }
  const Polygon whole = blade();
  Region leaf = core::intersect(core::enclosed(veins, core::FillRule::non_zero), {whole});
  leaf = core::unite(leaf, core::subtract({whole}, core::offset({whole}, -rim, arcs)));
  std::vector<Ring> foot;
  add_branch(foot, {{0, midrib_foot / 2}, {0, stalk + 10}}, midrib_foot, midrib_foot - 1);
  leaf = core::unite(leaf, core::enclosed(foot, core::FillRule::non_zero));
  leaf = core::offset(core::offset(leaf, fillet, arcs), -fillet, arcs);
  Polygon plate = *std::max_element(leaf.begin(), leaf.end(), [](const Polygon& a, const Polygon& b) {
    return core::area(a) < core::area(b);
  });
  std::erase_if(plate.holes, [](const Ring& hole) { return -core::signed_area(hole) < least_hole; });
  return plate;
}

}  // namespace unicursal::bench
