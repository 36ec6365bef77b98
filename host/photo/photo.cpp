#include "host/photo/photo.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::host {

bool Photo::holds(const core::Vec2& place) const {
  return place.x() >= 0.5 && place.y() >= 0.5 && place.x() <= static_cast<double>(width_) - 0.5 &&
         place.y() <= static_cast<double>(height_) - 0.5;
}

std::array<double, 3> Photo::between(const core::Vec2& place) const {
  const double left = std::floor(place.x() - 0.5), top = std::floor(place.y() - 0.5);
  const double right_part = place.x() - 0.5 - left, lower_part = place.y() - 0.5 - top;
  const auto x = static_cast<std::size_t>(left), y = static_cast<std::size_t>(top);
  const std::size_t next_x = std::min(x + 1, width_ - 1), next_y = std::min(y + 1, height_ - 1);
  const auto mixed = [&](std::uint8_t picture::Colour::*part) {
    const double upper = at(x, y).*part * (1 - right_part) + at(next_x, y).*part * right_part;
    const double lower = at(x, next_y).*part * (1 - right_part) + at(next_x, next_y).*part * right_part;
    return (upper * (1 - lower_part) + lower * lower_part) / 255;
  };
  return {mixed(&picture::Colour::r), mixed(&picture::Colour::g), mixed(&picture::Colour::b)};
}

}  // namespace unicursal::host
