// Numbers as strokes of the nozzle, in seven-segment digits. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "host/tune/strip_sizes.hpp"

namespace unicursal::host {

/// The width of the number.
double number_width(std::size_t number, const StripSizes& sizes);

/// The strokes of the number as open lines; `corner` is its lower left corner.
std::vector<std::vector<core::Vec2>> number_strokes(std::size_t number, const core::Vec2& corner,
                                                    const StripSizes& sizes);

}  // namespace unicursal::host
