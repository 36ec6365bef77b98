#include "firmware_gcode/route/simplify.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::gcode {
namespace {

/// Segments of a straight piece; the work grows with its square.
constexpr std::size_t longest_run = 64;

/// Returns whether the vertices between the segments `first` and `last` − 1 lie on a straight line. `last` is
/// at most the path's size.
bool straight(const core::BeadPath& path, std::size_t first, std::size_t last) {
  const core::Vec2 from = path.start(first), to = path.end(last - 1);
  const core::Vec2 way = to - from;
  const double length = way.norm();
  if (length == 0) return false;
  double reached = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const core::Vec2 offset = path.start(i) - from;
    const double along = offset.dot(way) / length;
    const double aside = std::abs(way.x() * offset.y() - way.y() * offset.x()) / length;
    if (aside > straight_tolerance || along <= reached || along >= length) return false;
    reached = along;
  }
  return true;
}

/// The index behind the last segment that can be joined to `first`.
std::size_t end_of_run(const core::BeadPath& path, std::size_t first) {
  double least = path.width(first), greatest = least;
  std::size_t last = first + 1;
  for (; last < path.size() && last - first < longest_run; ++last) {
    least = std::min(least, path.width(last));
    greatest = std::max(greatest, path.width(last));
    const bool alike = least > 0 && greatest <= (1 + width_tolerance) * least;
    if (!alike || path.beads[last].zone != path.beads[first].zone || !straight(path, first, last + 1)) break;
  }
  return last;
}

}  // namespace

core::BeadPath simplified(const core::BeadPath& path) {
  core::BeadPath result;
  result.beads.reserve(path.size());
  for (std::size_t i = 0; i < path.size();) {
    const std::size_t end = end_of_run(path, i);
    core::Bead bead = path.beads[i];
    for (std::size_t k = i + 1; k < end; ++k) bead.area += path.beads[k].area;
    result.beads.push_back(bead);
    i = end;
  }
  return result;
}

PlacedLayer simplified(PlacedLayer layer) {
  for (core::BeadPath& path : layer.paths) path = simplified(path);
  return layer;
}

}  // namespace unicursal::gcode
