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

Filaments::Filaments(std::span<const Colour> pure) {
  std::vector<Colour> colours(pure.begin(), pure.end());
  for (std::size_t f = colours.size(); f < usual_filaments.size(); ++f) colours.push_back(usual_filaments[f]);
  for (const Colour& colour : colours)
    absorbed_.push_back({absorption(colour.r), absorption(colour.g), absorption(colour.b)});
}

Colour colour_of(std::span<const double> shares, const Filaments& filaments) {
  assert(shares.size() <= filaments.size());
  std::array<double, 3> absorbed{};
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    for (std::size_t channel = 0; channel < absorbed.size(); ++channel)
      absorbed[channel] += shares[f] * filaments.absorbed(f)[channel];
  }
  return {reflected(absorbed[0]), reflected(absorbed[1]), reflected(absorbed[2])};
}

Colour lit(Colour colour, double light) {
  const auto changed = [light](std::uint8_t value) { return from_light(light * to_light(value)); };
  return {changed(colour.r), changed(colour.g), changed(colour.b)};
}

}  // namespace unicursal::picture
