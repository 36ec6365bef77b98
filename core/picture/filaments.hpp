// What a mixture of filaments looks like. Pigments do not mix like light: dark ones cover light ones. The
// model is Beer and Lambert's for translucent plastic: light passes the parts one after the other, so for
// each of red, green and blue the logarithm of what comes back is the mean of the parts', weighted by their
// shares.
#pragma once

#include <array>
#include <span>

#include "core/picture/image.hpp"

namespace unicursal::picture {

/// Feeders 1 to 3: blue, red, white; the others: yellow, green, black.
inline constexpr std::array<Colour, 6> filaments{
    {{38, 96, 196}, {214, 52, 48}, {246, 240, 226}, {240, 190, 40}, {60, 150, 84}, {52, 52, 56}}};

/// `shares` of the first feeders; they add up to 1. At most six.
Colour mixed_filaments(std::span<const double> shares);

/// `light` times the colour's own, in linear light; white where that exceeds it.
Colour lit(Colour colour, double light);

}  // namespace unicursal::picture
