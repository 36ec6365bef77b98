#include "core/picture/filaments.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace unicursal::picture {
namespace {

using PerBand = Eigen::Array<double, bands, 1>;

constexpr std::size_t channel_bands = bands / 3;  ///< of red, green or blue

PerBand per_band(const Reflectance& of) {
  return Eigen::Map<const PerBand>(of.data());
}

/// Of an opaque layer: the ratio of absorption to scattering.
double ratio_of(double reflected) {
  return (1 - reflected) * (1 - reflected) / (2 * reflected);
}

/// The bands go from blue to red.
std::size_t channel_of(std::size_t band) {
  return 2 - band / channel_bands;
}

Eigen::Index first_band_of(std::size_t channel) {
  return static_cast<Eigen::Index>((2 - channel) * channel_bands);
}

Light lost_between(std::span<const double> shares, const std::vector<Mixing::Pair>& pairs) {
  Light lost{};
  for (const Mixing::Pair& pair : pairs) {
    if (pair.one >= shares.size() || pair.other >= shares.size()) continue;
    const double together = shares[pair.one] * shares[pair.other];
    for (std::size_t c = 0; c < lost.size(); ++c) lost[c] += pair.loss[c] * together;
  }
  return lost;
}

}  // namespace

Filaments::Filaments() {
  static const Filaments usual{std::span<const Colour>(usual_filaments)};
  *this = usual;
}

Filaments::Filaments(std::span<const Colour> pure, const Mixing& mixing) : Filaments(mixing) {
  for (const Colour& colour : pure) add(light_of(colour), mixing);
  if (size() >= usual_filaments.size()) return;
  const Filaments usual;
  const bool same = lift_ == usual.lift_;
  for (std::size_t f = size(); f < usual_filaments.size(); ++f) {
    if (same && f >= mixing.strengths.size())
      of_.push_back(usual.of_[f]);
    else
      add(light_of(usual_filaments[f]), mixing);
  }
}

Filaments::Filaments(std::span<const Light> lights, const Mixing& mixing) : Filaments(mixing) {
  for (const Light& light : lights) add(light, mixing);
}

Filaments::Filaments(const Mixing& mixing)
    : lift_(mixing.lift), as_strong_(mixing.strengths.empty()), pairs_(mixing.pairs) {}

void Filaments::add(const Light& light, const Mixing& mixing) {
  Filament filament;
  Light strength{1, 1, 1};
  if (size() < mixing.strengths.size()) strength = mixing.strengths[size()];
  const Reflectance reflected = reflectance_of(light);
  for (std::size_t band = 0; band < bands; ++band) {
    filament.strength[band] = strength[channel_of(band)];
    filament.averaged[band] = filament.strength[band] * ratio_of((reflected[band] + lift_) / (1 + lift_));
  }
  const Light seen = light_of(reflected);
  for (std::size_t c = 0; c < light.size(); ++c) filament.beyond[c] = light[c] - seen[c];
  of_.push_back(filament);
}

Light mixed_light(std::span<const double> shares, const Filaments& filaments) {
  assert(shares.size() <= filaments.size());
  PerBand ratio = PerBand::Zero(), strength = PerBand::Zero();
  Light light{};
  for (std::size_t f = 0; f < shares.size(); ++f) {
    if (shares[f] <= 0) continue;
    const Filaments::Filament& filament = filaments.of_[f];
    ratio += shares[f] * per_band(filament.averaged);
    if (!filaments.as_strong_) strength += shares[f] * per_band(filament.strength);
    for (std::size_t c = 0; c < light.size(); ++c) light[c] += shares[f] * filament.beyond[c];
  }
  if (!filaments.as_strong_) ratio /= strength;
  const double lift = filaments.lift_;
  PerBand reflected = (1 + lift) * (1 + ratio - (ratio * (ratio + 2)).sqrt()) - lift;
  if (!filaments.pairs_.empty()) {
    const Light lost = lost_between(shares, filaments.pairs_);
    for (std::size_t c = 0; c < lost.size(); ++c)
      reflected.segment<channel_bands>(first_band_of(c)) *= std::exp(-lost[c]);
  }
  for (std::size_t c = 0; c < light.size(); ++c) light[c] += (per_band(seen_of_band[c]) * reflected).sum();
  return light;
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
