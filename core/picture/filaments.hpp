// The colour of a mixture of filaments. Pigments do not mix like light: dark ones dominate light ones. The
// model is the Beer–Lambert law for translucent plastic, in which light passes through one part after the
// other: for red, green and blue alike, the logarithm of the reflected light is the mean over the parts,
// weighted by their shares.
#pragma once

#include <array>
#include <span>

#include "core/picture/image.hpp"

namespace unicursal::picture {

/// Feeders 1 to 3: blue, red, white; the others: yellow, green, black, cyan, magenta.
inline constexpr std::array<Colour, 8> filaments{{{38, 96, 196},
                                                  {214, 52, 48},
                                                  {246, 240, 226},
                                                  {240, 190, 40},
                                                  {60, 150, 84},
                                                  {52, 52, 56},
                                                  {40, 168, 190},
                                                  {196, 60, 140}}};

/// `shares`: one for each of the first feeders, at most eight, with a sum of 1.
Colour mixed_filaments(std::span<const double> shares);

/// The colour with its brightness in linear light multiplied by `light`; each of red, green and blue ends at
/// its maximum.
Colour lit(Colour colour, double light);

}  // namespace unicursal::picture
