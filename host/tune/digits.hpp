// Numbers as strokes of a nozzle, in the seven segments of a pocket calculator. mm.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "host/tune/strip_sizes.hpp"

namespace unicursal::host {

/// How wide the number is.
double number_width(std::size_t number, const StripSizes& sizes);

/// Its strokes, open lines; `corner` is the lower left one.
std::vector<std::vector<core::Vec2>> number_strokes(std::size_t number, const core::Vec2& corner,
                                                    const StripSizes& sizes);

}  // namespace unicursal::host
