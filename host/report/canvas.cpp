#include "host/report/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace unicursal::host {
namespace {

constexpr double margin = 8;  // pixels

picture::Image blank(const CanvasSize& size, picture::Colour background) {
  const core::Vec2 drawn = size.extent.size() * size.scale + core::Vec2::Constant(2 * margin);
  return {static_cast<std::size_t>(std::ceil(std::max(drawn.x(), size.least_width))),
          static_cast<std::size_t>(std::ceil(drawn.y() + size.caption_room)), background};
}

void add_crossings(const Canvas& canvas, const core::Ring& ring, double y, std::vector<double>& crossings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const core::Vec2 a = canvas.at(ring[i]), b = canvas.at(ring[(i + 1) % ring.size()]);
    if ((a.y() <= y) != (b.y() <= y))
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

}  // namespace

Canvas::Canvas(const CanvasSize& size, picture::Colour background)
    : scale_(size.scale), image_(blank(size, background)) {
  const double centred = (static_cast<double>(image_.width()) / scale_ - size.extent.size().x()) / 2;
  const double height = static_cast<double>(image_.height()) - size.caption_room - margin;
  const double left = size.least_width > 0 ? centred : margin / scale_;
  origin_ = {size.extent.min.x() - left, size.extent.min.y() + height / scale_};
}

core::Vec2 Canvas::at(const core::Vec2& point) const {
  return {(point.x() - origin_.x()) * scale_, (origin_.y() - point.y()) * scale_};
}

void Canvas::fill(const core::Polygon& polygon, picture::Colour colour) {
  const core::Box box = core::bounds(polygon);
  const auto last_row = static_cast<double>(image_.height()) - 1;
  const double top = std::clamp(std::floor(at(box.max).y()), 0.0, last_row);
  const double bottom = std::clamp(std::ceil(at(box.min).y()), 0.0, last_row);
  std::vector<double> crossings;
  for (double row = top; row <= bottom; ++row) {
    crossings.clear();
    add_crossings(*this, polygon.outer, row + 0.5, crossings);
    for (const core::Ring& hole : polygon.holes) add_crossings(*this, hole, row + 0.5, crossings);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double from = std::max(0.0, std::ceil(crossings[i] - 0.5));
      const double to = std::min(static_cast<double>(image_.width()) - 1, std::floor(crossings[i + 1] - 0.5));
      for (double x = from; x <= to; ++x)
        image_.set(static_cast<std::size_t>(x), static_cast<std::size_t>(row), colour);
    }
  }
}

void Canvas::outline(const core::Polygon& polygon, double thickness, picture::Colour colour) {
  ring(polygon.outer, thickness, colour);
  for (const core::Ring& hole : polygon.holes) ring(hole, thickness, colour);
}

void Canvas::ring(const core::Ring& ring, double thickness, picture::Colour colour) {
  for (std::size_t i = 0; i < ring.size(); ++i) line(ring[i], ring[(i + 1) % ring.size()], thickness, colour);
}

void Canvas::line(const core::Vec2& a, const core::Vec2& b, double thickness, picture::Colour colour) {
  const core::Vec2 from = at(a), to = at(b);
  image_.stroke(from.x(), from.y(), to.x(), to.y(), thickness, colour);
}

double scale_for(const core::Box& extent, double bead_width, double pixels_per_bead, double longest_side) {
  const double size = std::max(extent.size().maxCoeff(), bead_width);
  return std::min(pixels_per_bead / bead_width, longest_side / size);
}

}  // namespace unicursal::host
