// A second opinion on how filaments mix, written apart from core/picture/filaments.hpp: the two-constant
// theory of Kubelka and Munk over 31 wavelengths, with Saunderson's correction for the surface, seen in
// daylight by the observer of 1931. Each pigment absorbs and scatters in a way of its own. A printer that
// mixes like this is what a fit of filaments has to follow without knowing it.
//
// Sources: Kubelka (1948), "New contributions to the optics of intensely light-scattering materials";
// Saunderson (1942), "Calculation of the color of pigmented plastics"; the observer's curves as sums of
// Gaussians: Wyman, Sloan and Shirley (2013), "Simple analytic approximations to the CIE XYZ color matching
// functions"; D65: CIE 15.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "core/picture/lab.hpp"

namespace unicursal::test {

constexpr std::size_t wavelengths = 31;  ///< 400 to 700 nm
using Spectrum = std::array<double, wavelengths>;

inline double nanometres(std::size_t at) {
  return 400 + 10 * static_cast<double>(at);
}

/// What a filament does to light, for each wavelength: a unit is what the plain plastic scatters.
struct Pigments {
  Spectrum absorption{}, scattering{};
};

class OtherOptics {
 public:
  explicit OtherOptics(std::vector<Pigments> filaments) : filaments_(std::move(filaments)) {}

  std::size_t size() const { return filaments_.size(); }

  picture::Light light(std::span<const double> shares) const {
    Spectrum reflected{};
    for (std::size_t at = 0; at < wavelengths; ++at) {
      double absorbed = 0, scattered = 0;
      for (std::size_t f = 0; f < shares.size(); ++f) {
        absorbed += shares[f] * filaments_[f].absorption[at];
        scattered += shares[f] * filaments_[f].scattering[at];
      }
      reflected[at] = at_surface(of_thick_layer(absorbed / scattered));
    }
    return seen(reflected);
  }

  picture::Light pure(std::size_t filament) const {
    std::vector<double> shares(size());
    shares[filament] = 1;
    return light(shares);
  }

 private:
  static double of_thick_layer(double ratio) { return 1 + ratio - std::sqrt(ratio * ratio + 2 * ratio); }

  /// A thirtieth is reflected at the surface, where half of it misses the eye; half of the light from inside
  /// is thrown back.
  static double at_surface(double inside) {
    constexpr double outer = 1.0 / 30, inner = 0.5;
    return outer / 2 + (1 - outer) * (1 - inner) * inside / (1 - inner * inside);
  }

  static picture::Light seen(const Spectrum& reflected) {
    static constexpr Spectrum daylight{82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81, 114.86,
                                       115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
                                       100.00, 96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,
                                       83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61};
    std::array<double, 3> xyz{}, white{};
    for (std::size_t at = 0; at < wavelengths; ++at) {
      const std::array<double, 3> eye = observer(nanometres(at));
      for (std::size_t i = 0; i < xyz.size(); ++i) {
        xyz[i] += daylight[at] * eye[i] * reflected[at];
        white[i] += daylight[at] * eye[i];
      }
    }
    const double x = 0.95047 * xyz[0] / white[0], y = xyz[1] / white[1], z = 1.08883 * xyz[2] / white[2];
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
  }

  static std::array<double, 3> observer(double nm) {
    const auto lobe = [nm](double middle, double below, double above) {
      const double t = (nm - middle) * (nm < middle ? below : above);
      return std::exp(-t * t / 2);
    };
    return {0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323) -
                0.065 * lobe(501.1, 0.0490, 0.0382),
            0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
            1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725)};
  }

  std::vector<Pigments> filaments_;
};

/// The kinds of filaments that people load; how much pigment and where it absorbs differs from spool to
/// spool.
enum class Dye { white, black, red, yellow, green, blue, cyan, magenta };

template <class Random>
Pigments pigments_of(Dye dye, Random& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  // Titanium dioxide scatters; nearly all opaque filaments hold some.
  const double titanium = dye == Dye::white ? between(6, 10) : dye == Dye::black ? 0 : between(0.5, 2.5);
  const double haze = between(0.003, 0.02), strength = between(4, 10), shift = between(-8, 8);
  const double slope = between(9, 18);
  const auto edge = [&](double nm, double at) { return 1 / (1 + std::exp((nm - at - shift) / slope)); };
  const auto band = [&](double nm, double at, double width) {
    const double t = (nm - at - shift) / width;
    return std::exp(-t * t / 2);
  };
  const auto absorbed = [&](double nm) {
    switch (dye) {
      case Dye::white:
        return 0.1 * edge(nm, 420);
      case Dye::black:
        return 3.0;
      case Dye::red:
        return edge(nm, 595);
      case Dye::yellow:
        return edge(nm, 500);
      case Dye::green:
        return 0.8 * band(nm, 430, 40) + band(nm, 650, 55);
      case Dye::blue:
        return band(nm, 600, 65) + 0.5 * band(nm, 680, 50);
      case Dye::cyan:
        return band(nm, 640, 55);
      case Dye::magenta:
        return band(nm, 545, 38);
    }
    return 0.0;
  };
  Pigments result;
  for (std::size_t at = 0; at < wavelengths; ++at) {
    const double nm = nanometres(at);
    result.absorption[at] = haze + strength * absorbed(nm);
    result.scattering[at] = 1 + titanium * std::pow(nm / 550, -0.8);
  }
  return result;
}

}  // namespace unicursal::test
