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

using Row = std::array<double, 3>;

/// Linear sRGB to the primaries of ITU-R BT.2020, and back. Nearly all colours of plastic lie within these,
/// so that no channel of a saturated filament is dark only because sRGB cannot show it.
constexpr std::array<Row, 3> to_wide{
    {{0.627404, 0.329283, 0.043313}, {0.069097, 0.919540, 0.011362}, {0.016391, 0.088013, 0.895595}}};
constexpr std::array<Row, 3> from_wide{
    {{1.660491, -0.587641, -0.072850}, {-0.124550, 1.132900, -0.008349}, {-0.018151, -0.100579, 1.118730}}};

Light product(const std::array<Row, 3>& rows, const Light& light) {
  Light result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = rows[i][0] * light[0] + rows[i][1] * light[1] + rows[i][2] * light[2];
  return result;
}

/// What is averaged of a negative logarithm of light; brighter than white counts as white.
double averaged_of(double x, double power, double bend) {
  return std::pow(bend > 0 ? std::sinh(bend * std::max(0.0, x)) / bend : std::max(0.0, x), power);
}

double logarithm_of(double averaged, double power, double bend) {
  const double root = std::pow(averaged, 1 / power);
  return bend > 0 ? std::asinh(bend * root) / bend : root;
}

}  // namespace

Filaments::Filaments(std::span<const Colour> pure, const Mixing& mixing) {
  std::vector<Colour> colours(pure.begin(), pure.end());
  for (std::size_t f = colours.size(); f < usual_filaments.size(); ++f) colours.push_back(usual_filaments[f]);
  std::vector<Light> lights;
  for (const Colour& colour : colours) lights.push_back(light_of(colour));
  *this = Filaments(std::span<const Light>(lights), mixing);
}

Filaments::Filaments(std::span<const Light> lights, const Mixing& mixing)
    : usual_(mixing.usual()), power_(mixing.power), bend_(mixing.bend), pairs_(mixing.pairs) {
  for (const Light& light : lights) {
    Filament filament;
    const Light known = usual_ ? light : product(to_wide, light);
    for (std::size_t channel = 0; channel < light.size(); ++channel) {
      const double logarithm = std::log(std::max(darkest, known[channel]));
      filament.averaged[channel] = usual_ ? logarithm : averaged_of(-logarithm, power_, bend_);
    }
    filament.strength = usual_strength(light);
    filament.strengths = {filament.strength, filament.strength, filament.strength};
    if (of_.size() < mixing.strengths.size()) filament.strengths = mixing.strengths[of_.size()];
    of_.push_back(filament);
  }
  for (Mixing::Pair& pair : pairs_) {
    assert(pair.one < size() && pair.other < size());
    for (double& loss : pair.loss) loss -= Mixing::usual_loss;
  }
}

double Filaments::usual_strength(const Light& light) {
  return std::pow(std::max(darkest_strength, luminance(light)), -strength_exponent);
}

Light Filaments::mixed_as_usual(std::span<const double> shares) const {
  Light sum{};
  double weights = 0, squares = 0;
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    const double weight = shares[f] * of_[f].strength;
    weights += weight;
    squares += shares[f] * shares[f];
    for (std::size_t channel = 0; channel < sum.size(); ++channel)
      sum[channel] += weight * of_[f].averaged[channel];
  }
  for (double& channel : sum) channel = std::exp(channel / weights - loss * (1 - squares));
  return sum;
}

Light Filaments::mixed(std::span<const double> shares) const {
  Light sum{}, weights{}, result{};
  double squares = 0;
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    squares += shares[f] * shares[f];
    for (std::size_t channel = 0; channel < sum.size(); ++channel) {
      const double weight = shares[f] * of_[f].strengths[channel];
      weights[channel] += weight;
      sum[channel] += weight * of_[f].averaged[channel];
    }
  }
  Light lost{};
  lost.fill(loss * (1 - squares));
  for (const Mixing::Pair& pair : pairs_) {
    if (pair.one >= shares.size() || pair.other >= shares.size()) continue;
    for (std::size_t channel = 0; channel < lost.size(); ++channel)
      lost[channel] += pair.loss[channel] * shares[pair.one] * shares[pair.other];
  }
  for (std::size_t channel = 0; channel < result.size(); ++channel)
    result[channel] = std::exp(-logarithm_of(sum[channel] / weights[channel], power_, bend_) - lost[channel]);
  return product(from_wide, result);
}

Light mixed_light(std::span<const double> shares, const Filaments& filaments) {
  assert(shares.size() <= filaments.size());
  return filaments.usual_ ? filaments.mixed_as_usual(shares) : filaments.mixed(shares);
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
