// Plain names for colours.
#pragma once

#include <string>

#include "core/picture/lab.hpp"

namespace unicursal::picture {

/// The nearest of some thirty words, such as "olive" or "pale blue".
std::string name_of(const Lab& colour);

}  // namespace unicursal::picture
