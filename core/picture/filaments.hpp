// The colour of a mixture of filaments. Pigments do not mix like light: a mixture of yellow and blue is
// green, and dark ones dominate light ones. After Kubelka and Munk, what is averaged over the parts, weighted
// by their shares, is (1 - r)² ÷ 2r, the ratio of absorption to scattering, in twelve bands of the spectrum,
// which are guessed from each filament's colour (reflectance.hpp). r is its reflectance lifted by a
// twentieth, (reflectance + 0.05) ÷ 1.05, since no plastic swallows all the light that falls on it.
//
// The law and its number were chosen by measurement: of 218 mixtures of two and three filaments that Prusa
// Research has printed and measured (prusa-fdm-mixer, its fitting-set.jsonl and holdout-set.jsonl), the
// median of ΔE2000 is 5.9; with the law of Beer and Lambert in three channels, and strengths and a loss
// fitted to these very prints, it is 7.0, with that of Kubelka and Munk in three channels 10.1, with the mean
// of linear light 14.3. What remains is how strongly each filament colours, which its colour does not say:
// after a fit to other mixtures of the same filaments the median is 2.3. `tests/bench/run --colours FILE...`
// repeats this. Departure: those prints alternate layers, while a mixing nozzle mixes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/picture/lab.hpp"
#include "core/picture/reflectance.hpp"

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
/// printed mixtures. "Red", "green" and "blue" are the light of 600 to 700, 500 to 600 and 400 to 500 nm.
struct Mixing {
  static constexpr double usual_lift = 0.05;

  double lift = usual_lift;
  /// Of the first filaments, how strongly each colours a mixture in red, green and blue; the others: 1.
  std::vector<Light> strengths;
  /// Of each two filaments: a mixture keeps e^(−loss · share · other share) of its red, green and blue.
  struct Pair {
    std::size_t one = 0, other = 1;
    Light loss{};
  };
  std::vector<Pair> pairs;

  bool usual() const { return lift == usual_lift && strengths.empty() && pairs.empty(); }
};

/// The filaments of a printer's feeders, as far as their colours are concerned.
class Filaments {
 public:
  /// The usual ones.
  Filaments();
  /// Feeders beyond `pure` have the usual colours.
  explicit Filaments(std::span<const Colour> pure, const Mixing& mixing = {});
  /// Of exactly these, which may be darker or brighter than bytes can say.
  explicit Filaments(std::span<const Light> lights, const Mixing& mixing = {});

  /// At least eight, if they come from colours.
  std::size_t size() const { return of_.size(); }

 private:
  struct Filament {
    Reflectance averaged{};  ///< what is averaged of it, times its strength
    Reflectance strength{};
    Light beyond{};  ///< what its colour has and its guessed reflectance does not show
  };

  explicit Filaments(const Mixing& mixing);
  void add(const Light& light, const Mixing& mixing);

  std::vector<Filament> of_;
  double lift_ = Mixing::usual_lift;
  bool as_strong_ = true;  ///< all strengths are 1
  std::vector<Mixing::Pair> pairs_;

  friend Light mixed_light(std::span<const double> shares, const Filaments& filaments);
};

/// `shares`: one for each of the first feeders, with a sum of 1. Precondition: not more than the filaments.
Light mixed_light(std::span<const double> shares, const Filaments& filaments);
Colour colour_of(std::span<const double> shares, const Filaments& filaments);

/// The colour with its brightness in linear light multiplied by `light`; each of red, green and blue ends at
/// its maximum.
Colour lit(Colour colour, double light);

}  // namespace unicursal::picture
