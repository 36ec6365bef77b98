// Bands along lines, and caps at their ends, as polygons. mm.
#pragma once

#include <vector>

#include "core/geometry/region.hpp"

namespace unicursal::core {

/// A point of a line in the middle of a place of width 2 · `radius`.
struct BandPoint {
  Vec2 position{0, 0};
  double radius = 0;
  bool four = false;  ///< four strands run there
};

double length(const std::vector<BandPoint>& line);
/// The first part of a line, `most` mm long; empty if that is not positive.
std::vector<BandPoint> shortened(const std::vector<BandPoint>& line, double most);

/// The line without points that are nearer than `least` mm to the one before; both ends stay.
std::vector<BandPoint> without_crumbs(const std::vector<BandPoint>& line, double least);

/// A round end has a half disc behind the line's end; a flat one ends there.
enum class BandEnds { round, round_front };

/// What is nearer to the line than `halves` says at each of its points, as rings that overlap.
std::vector<Ring> band(const std::vector<BandPoint>& line, const std::vector<double>& halves, BandEnds ends);

/// What lies at least `depth` mm inside the border, within a disc a little larger than the one of `radius` mm
/// that fits at `centre`.
Region cap(const Polygon& region, const Vec2& centre, double radius, double depth);

}  // namespace unicursal::core
