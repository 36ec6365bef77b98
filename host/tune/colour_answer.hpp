// How the colour of a strip answers to the share of a change that has arrived.
//
// Colours do not change in proportion to shares: a little red shows in white at once, a little white in red
// hardly. Lines whose shares of the change are known show how the colour answers, in the same photo. After
// the law of Beer and Lambert, and that of Kubelka and Munk, the logit of the way that the logarithm of its
// light has gone differs from the logit of the share by about a constant. That difference, the lift, is here
// a smooth curve over the logit of the share: a cubic spline. It is constant below 1.5 % and above 98.5 %. So
// no model of the filaments and no calibrated camera is needed. Departure: it is not known how a bed shines
// through, nor how a camera bends colours; the fit (curve_fit.hpp) leaves room for both.
#pragma once

#include <array>

#include "host/tune/strip.hpp"

namespace unicursal::host {

/// Encoded red, green and blue, 0…1: steps of equal size look about equally large.
using Seen = std::array<double, 3>;

/// The colours of the reference lines, indexed by Shade, and the standard deviation of each. The bed shines
/// through a thin bead more than through a fat one, so there are lines of both widths.
struct ReferenceColours {
  struct Lines {
    std::array<Seen, shade_count> colour{};
    std::array<double, shade_count> doubt{};
  };
  Lines thin, fat;
};

/// One channel of beads of one width.
struct ColourLaw {
  /// Coefficients of a uniform cubic B-spline.
  static constexpr std::size_t coefficients = 9;
  /// The four of them that count at a share, and by how much.
  struct Weights {
    std::size_t first = 0;
    std::array<double, 4> of{};
  };

  double from = 0, to = 0;  ///< natural logarithms of the light
  std::array<double, coefficients> lift{};

  static Weights weights_at(double share);
  /// The way that the logarithm has gone, 0 to 1.
  double gone(double share) const;
  double log_light(double share) const { return from + gone(share) * (to - from); }
};

/// How strongly laws are held to be smooth: standard deviations of the second and third differences of the
/// coefficients, and of second differences between thin and fat. After the law of Kubelka and Munk, for
/// pigments of 5 to 80 % reflectance and scattering of 1 : 2 to 2 : 1, second differences are mostly 0.1 to
/// 0.2.
inline constexpr double lift_bend = 0.25, lift_jerk = 0.12, lift_width = 0.12, lift_usual = 2;

class ColourAnswer {
 public:
  explicit ColourAnswer(const ReferenceColours& references);

  /// The colour after a share of the change, 0 to 1.
  Seen operator()(double share, double fat) const;
  /// How far a colour has gone from the first pure one (0) to the second (1), in encoded values.
  double change(const Seen& colour, double fat) const;
  /// Channels that hardly differ between both pure colours say nothing.
  bool uses(std::size_t channel) const { return used_[channel]; }
  const ColourLaw& thin(std::size_t channel) const { return thin_[channel]; }
  const ColourLaw& fat(std::size_t channel) const { return fat_[channel]; }

 private:
  std::array<ColourLaw, 3> thin_, fat_;
  std::array<bool, 3> used_{};
};

}  // namespace unicursal::host
