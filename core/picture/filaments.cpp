#include "core/picture/filaments.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace unicursal::picture {

namespace {

constexpr double darkest = 0.002;  // reflectance: no filament is perfectly black

double to_light(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint8_t from_light(double light) {
  const double v = std::clamp(light, 0.0, 1.0);
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

double absorption(std::uint8_t value) {
  return -std::log(std::max(darkest, to_light(value)));
}

std::uint8_t reflected(double absorbed) {
  return from_light(std::exp(-absorbed));
}

}  // namespace

Colour mixed_filaments(std::span<const double> shares) {
  assert(shares.size() <= filaments.size());
  double r = 0, g = 0, b = 0;
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    r += shares[f] * absorption(filaments[f].r);
    g += shares[f] * absorption(filaments[f].g);
    b += shares[f] * absorption(filaments[f].b);
  }
  return {reflected(r), reflected(g), reflected(b)};
}

Colour lit(Colour colour, double light) {
  const auto changed = [light](std::uint8_t value) { return from_light(light * to_light(value)); };
  return {changed(colour.r), changed(colour.g), changed(colour.b)};
}

}  // namespace unicursal::picture
