#include "core/picture/filaments.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace unicursal::picture {
namespace {

constexpr double darkest = 0.0015;         // no filament is perfectly black
constexpr double darkest_strength = 0.01;  // luminance below which a filament colours no more strongly
constexpr double strength_exponent = 0.22, loss = 0.12;

double luminance(const Light& light) {
  return 0.2126729 * light[0] + 0.7151522 * light[1] + 0.0721750 * light[2];
}

}  // namespace

Filaments::Filaments(std::span<const Colour> pure) {
  std::vector<Colour> colours(pure.begin(), pure.end());
  for (std::size_t f = colours.size(); f < usual_filaments.size(); ++f) colours.push_back(usual_filaments[f]);
  std::vector<Light> lights;
  for (const Colour& colour : colours) lights.push_back(light_of(colour));
  *this = Filaments(std::span<const Light>(lights));
}

Filaments::Filaments(std::span<const Light> lights) {
  for (const Light& light : lights) {
    Filament filament;
    for (std::size_t channel = 0; channel < light.size(); ++channel)
      filament.logarithms[channel] = std::log(std::max(darkest, light[channel]));
    filament.strength = std::pow(std::max(darkest_strength, luminance(light)), -strength_exponent);
    of_.push_back(filament);
  }
}

Light mixed_light(std::span<const double> shares, const Filaments& filaments) {
  assert(shares.size() <= filaments.size());
  Light sum{};
  double weights = 0, squares = 0;
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    const double weight = shares[f] * filaments.strength(f);
    weights += weight;
    squares += shares[f] * shares[f];
    for (std::size_t channel = 0; channel < sum.size(); ++channel)
      sum[channel] += weight * filaments.logarithms(f)[channel];
  }
  for (double& channel : sum) channel = std::exp(channel / weights - loss * (1 - squares));
  return sum;
}

Colour colour_of(std::span<const double> shares, const Filaments& filaments) {
  return colour_of(mixed_light(shares, filaments));
}

Colour lit(Colour colour, double light) {
  Light linear = light_of(colour);
  for (double& channel : linear) channel *= light;
  return colour_of(linear);
}

}  // namespace unicursal::picture
