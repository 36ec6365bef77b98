// A picture of the colours that filaments make.
#pragma once

#include <cstddef>

#include "core/picture/filaments.hpp"
#include "core/picture/image.hpp"

namespace unicursal::host {

/// A triangle for every three feeders, with a feeder's own colour in each corner and its number beside it,
/// and every mixture between them; a bar for two feeders, a square for one. Precondition: 1 ≤ feeders ≤ 8.
picture::Image gamut_picture(const picture::Filaments& filaments, std::size_t feeders);

}  // namespace unicursal::host
