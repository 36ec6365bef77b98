#include "firmware_gcode/toolpath/skirt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::gcode {
namespace {

constexpr double arc_step = std::numbers::pi / 12;  ///< greatest turn between chords of a rounded corner
constexpr double edge_clearance = 1;  ///< mm from the outer edge of the outermost ring to the bed's edge

double cross(const core::Vec2& a, const core::Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The convex hull, counter-clockwise, by Andrew's monotone chain.
std::vector<core::Vec2> hull(std::vector<core::Vec2> points) {
  const auto before = [](const core::Vec2& a, const core::Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(points.begin(), points.end(), before);
  std::vector<core::Vec2> chain;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = chain.size();
    for (const core::Vec2& p : points) {
      while (chain.size() >= base + 2 &&
             cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0) {
        chain.pop_back();
      }
      chain.push_back(p);
    }
    if (!chain.empty()) chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

/// The hull offset outwards by `distance`, with rounded corners.
std::vector<core::Vec2> pushed_out(const std::vector<core::Vec2>& hull, double distance) {
  std::vector<core::Vec2> ring;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const core::Vec2 in = hull[i] - hull[(i + hull.size() - 1) % hull.size()];
    const core::Vec2 out = hull[(i + 1) % hull.size()] - hull[i];
    const double from = std::atan2(-in.x(), in.y());  // of the outward normal
    double turn = std::atan2(cross(in, out), in.dot(out));
    if (turn < 0) turn += 2 * std::numbers::pi;
    const auto chords = static_cast<int>(std::ceil(turn / arc_step));
    for (int k = 0; k <= chords; ++k) {
      const double angle = from + (chords > 0 ? turn * k / chords : 0);
      ring.push_back(hull[i] + distance * core::Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  return ring;
}

core::BeadPath bead_ring(const std::vector<core::Vec2>& ring, double width) {
  core::BeadPath path;
  for (const core::Vec2& point : ring) path.beads.push_back({point, 0.0, 0});
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = width * path.length(i);
  return path;
}

/// The distance between the points and the nearest edge of the bed, mm.
double room_round(const std::vector<core::Vec2>& points, const Printer& printer) {
  double room = std::min(printer.bed[0], printer.bed[1]);
  for (const core::Vec2& p : points) {
    room = std::min({room, p.x(), p.y(), printer.bed[0] - p.x(), printer.bed[1] - p.y()});
  }
  return room;
}

}  // namespace

std::vector<core::BeadPath> skirt(const PlacedLayer& layer, const Skirt& asked, const Printer& printer) {
  std::vector<core::Vec2> points;
  double area = 0, length = 0;
  for (const core::BeadPath& path : layer.paths) {
    for (const core::Bead& bead : path.beads) points.push_back(bead.position);
    area += path.total_area(), length += path.total_length();
  }
  if (asked.loops <= 0 || length == 0) return {};
  const double width = std::clamp(area / length, printer.bead_width_range[0], printer.bead_width_range[1]);
  const std::vector<core::Vec2> border = hull(points);
  const double taken = width * (asked.loops + 0.5);  // by the rings, and half a bead of the part
  const double distance = std::min(asked.distance, room_round(border, printer) - taken - edge_clearance);
  if (distance < width || border.size() < 3) return {};
  std::vector<core::BeadPath> rings;
  for (int ring = asked.loops; ring-- > 0;) {
    rings.push_back(bead_ring(pushed_out(border, distance + width * (ring + 1)), width));
  }
  return rings;
}

double skirt_reach(const Skirt& asked, const Printer& printer) {
  return asked.loops > 0 ? asked.distance + asked.loops * printer.bead_width_range[1] : 0;
}

}  // namespace unicursal::gcode
