#include "host/photo/marks.hpp"

#include <cmath>
#include <numbers>

namespace unicursal::host {
namespace {

constexpr double side_length = 0.7;  ///< of the polygons that stand for circles, in widths of the line

void add_circle(std::vector<core::Vec2>& stroke, const core::Vec2& centre, double radius, double line) {
  const double around = 2 * std::numbers::pi;
  const auto sides = static_cast<int>(std::ceil(around * radius / (side_length * line)));
  for (int i = 0; i <= sides; ++i) {
    const double angle = around * i / sides;
    stroke.push_back(centre + radius * core::Vec2(std::cos(angle), std::sin(angle)));
  }
}

}  // namespace

MarkPlaces mark_places(const core::Box& box) {
  const core::Vec2 along(box.size().x(), 0), up(0, box.size().y());
  return {box.min, box.min + along, box.max, box.min + up, box.min + along / 3, box.min + up + along / 2};
}

std::vector<std::vector<core::Vec2>> mark_strokes(const core::Vec2& centre, double line) {
  const MarkSizes sizes(line);
  std::vector<core::Vec2> ring, disk;
  for (double radius = sizes.ring_outer - line / 2; radius > sizes.ring_inner; radius -= line)
    add_circle(ring, centre, radius, line);
  for (double radius = sizes.disk - line / 2; radius > line / 2; radius -= line)
    add_circle(disk, centre, radius, line);
  disk.push_back(centre);
  return {ring, disk};
}

}  // namespace unicursal::host
