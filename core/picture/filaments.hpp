// The colour of a mixture of filaments. Pigments do not mix like light: dark ones dominate light ones. The
// model is the Beer–Lambert law for translucent plastic, in which light passes through one part after the
// other: for red, green and blue alike, the logarithm of the reflected light is the mean over the parts,
// weighted by their shares. The light is linear, not the values of sRGB.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/picture/image.hpp"

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

/// The filaments of a printer's feeders, as far as their colours are concerned.
class Filaments {
 public:
  /// The usual ones.
  Filaments() : Filaments(std::span<const Colour>()) {}
  /// Feeders beyond `pure` have the usual colours.
  explicit Filaments(std::span<const Colour> pure);

  /// At least eight.
  std::size_t size() const { return absorbed_.size(); }
  /// What each channel absorbs, in linear light: −ln of what it reflects.
  const std::array<double, 3>& absorbed(std::size_t feeder) const { return absorbed_[feeder]; }

 private:
  std::vector<std::array<double, 3>> absorbed_;
};

/// `shares`: one for each of the first feeders, with a sum of 1. Precondition: not more than the filaments.
Colour colour_of(std::span<const double> shares, const Filaments& filaments);

/// The colour with its brightness in linear light multiplied by `light`; each of red, green and blue ends at
/// its maximum.
Colour lit(Colour colour, double light);

}  // namespace unicursal::picture
