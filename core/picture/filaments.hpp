// The colour of a mixture of filaments. Pigments do not mix like light: dark ones dominate light ones, and a
// mixture is darker than its parts. After the law of Beer and Lambert, for red, green and blue alike, the
// logarithm of the linear light is the mean over the parts, weighted by their shares and by how strongly they
// colour, luminance^-0.22. A mixture then keeps e^(−0.12 (1 − Σ share²)) of its light.
//
// The model and its two numbers were chosen by measurement: of 218 mixtures of two and three filaments that
// Prusa Research has printed and measured (prusa-fdm-mixer, its fitting-set.jsonl and holdout-set.jsonl), the
// median of ΔE2000 is 7.0; without the two numbers it is 8.2, with the law of Kubelka and Munk 10.1, with the
// mean of linear light 14.3. `tests/bench/run --colours FILE...` repeats this. Departure: the mean of cube
// roots (Yule and Nielsen, n = 3), with numbers fitted in the same way, comes to 6.1 there, but those prints
// alternate layers, which lie side by side like the dots of a halftone; it would draw half yellow and half
// blue as grey, where plastic that is mixed through is green.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/picture/lab.hpp"

namespace unicursal::picture {

/// Feeders 1 to 3: blue, red, white; the others: yellow, green, black, cyan, magenta.
inline constexpr std::array<Colour, 8> usual_filaments{{{38, 96, 196},
                                                        {214, 52, 48},
                                                        {246, 240, 226},
                                                        {240, 190, 40},
                                                        {60, 150, 84},
                                                        {52, 52, 56},
                                                        {40, 168, 190},
                                                        {196, 60, 140}}};

/// How filaments mix. The values here are those of the formula above; fit_filaments.hpp finds others from
/// printed mixtures. With x = −ln(light), what is averaged in each channel is (sinh(bend x) ÷ bend)^power,
/// which is x itself for a power of 1 and no bend (Beer and Lambert), and for a power of 2 and a bend of ½
/// the ratio of absorption to scattering of Kubelka and Munk. The channels of such a law are those of ITU-R
/// BT.2020 instead of sRGB, since saturated filaments lie beyond sRGB: a channel that is dark only because
/// sRGB cannot show the colour would say nothing of how it mixes.
struct Mixing {
  static constexpr double usual_loss = 0.24;

  double power = 1, bend = 0;
  /// Of the first filaments, how strongly each colours a mixture in each channel; the others have the usual
  /// strength.
  std::vector<Light> strengths;
  /// Of each two filaments: a mixture keeps e^(−loss · share · other share) of its light. The usual one is
  /// the same for all, as the sum over all two of 0.24 share · other share is 0.12 (1 − Σ share²).
  struct Pair {
    std::size_t one = 0, other = 1;
    Light loss{usual_loss, usual_loss, usual_loss};
  };
  std::vector<Pair> pairs;

  bool usual() const { return power == 1 && bend == 0 && strengths.empty() && pairs.empty(); }
};

/// The filaments of a printer's feeders, as far as their colours are concerned.
class Filaments {
 public:
  /// The usual ones.
  Filaments() : Filaments(std::span<const Colour>()) {}
  /// Feeders beyond `pure` have the usual colours.
  explicit Filaments(std::span<const Colour> pure, const Mixing& mixing = {});
  /// Of exactly these, which may be darker or brighter than bytes can say.
  explicit Filaments(std::span<const Light> lights, const Mixing& mixing = {});

  /// At least eight, if they come from colours.
  std::size_t size() const { return of_.size(); }
  /// How strongly a filament of this light colours a mixture unless something else is known.
  static double usual_strength(const Light& light);

 private:
  struct Filament {
    Light averaged{};  ///< what is averaged of it: the logarithms of its light, or the formula of Mixing
    double strength = 1;
    Light strengths{1, 1, 1};  ///< of a mixing that is not the usual one
  };

  Light mixed(std::span<const double> shares) const;
  Light mixed_as_usual(std::span<const double> shares) const;

  std::vector<Filament> of_;
  bool usual_ = true;
  double power_ = 1, bend_ = 0;
  std::vector<Mixing::Pair> pairs_;  ///< with the loss beyond the usual one

  friend Light mixed_light(std::span<const double> shares, const Filaments& filaments);
};

/// `shares`: one for each of the first feeders, with a sum of 1. Precondition: not more than the filaments.
Light mixed_light(std::span<const double> shares, const Filaments& filaments);
Colour colour_of(std::span<const double> shares, const Filaments& filaments);

/// The colour with its brightness in linear light multiplied by `light`; each of red, green and blue ends at
/// its maximum.
Colour lit(Colour colour, double light);

}  // namespace unicursal::picture
