// What a mixture looks like: the feeders' filaments mixed in linear light.
#pragma once

#include "core/picture/image.hpp"
#include "sim/motion/move.hpp"

namespace unicursal::sim {

/// Precondition: the shares add up to 1.
picture::Colour colour_of(const PerFeeder<double>& shares);
/// `light` in 0…1 of the colour's own.
picture::Colour darker(picture::Colour colour, double light);

}  // namespace unicursal::sim
