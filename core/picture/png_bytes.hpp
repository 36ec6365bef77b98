// A picture as the content of a PNG file, for those who do not want it in a file.
#pragma once

#include <string>

#include "core/picture/image.hpp"

namespace unicursal::picture {

std::string png_bytes(const Image& image);

}  // namespace unicursal::picture
