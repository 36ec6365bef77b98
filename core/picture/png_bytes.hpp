// A picture as the content of a PNG file, as write_png() (image.hpp) writes it.
#pragma once

#include <string>

#include "core/picture/image.hpp"

namespace unicursal::picture {

std::string png_bytes(const Image& image);

}  // namespace unicursal::picture
