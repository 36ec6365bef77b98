#include "sim/bed/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace unicursal::sim {

namespace {

// Feeders 1 to 3: blue, red, white, as in the paper's prints; the others: yellow, green, black.
constexpr PerFeeder<picture::Colour> filaments{
    {{38, 96, 196}, {214, 52, 48}, {246, 240, 226}, {240, 190, 40}, {60, 150, 84}, {52, 52, 56}}};

// The sRGB transfer curve without its short straight foot, which no eye would miss here.
constexpr double gamma_exponent = 2.2;
double to_light(std::uint8_t value) {
  return std::pow(value / 255.0, gamma_exponent);
}
std::uint8_t from_light(double light) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::pow(std::clamp(light, 0.0, 1.0), 1 / gamma_exponent)));
}

}  // namespace

picture::Colour colour_of(const PerFeeder<double>& shares) {
  double r = 0, g = 0, b = 0;
  for (std::size_t i = 0; i < max_feeders; ++i) {
    r += shares[i] * to_light(filaments[i].r);
    g += shares[i] * to_light(filaments[i].g);
    b += shares[i] * to_light(filaments[i].b);
  }
  return {from_light(r), from_light(g), from_light(b)};
}

picture::Colour darker(picture::Colour colour, double light) {
  const auto dim = [light](std::uint8_t value) { return from_light(light * to_light(value)); };
  return {dim(colour.r), dim(colour.g), dim(colour.b)};
}

}  // namespace unicursal::sim
