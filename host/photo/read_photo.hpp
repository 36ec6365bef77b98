// Reads a photo from a file: JPEG by libjpeg-turbo, PNG by libpng.
#pragma once

#include <filesystem>

#include "host/photo/photo.hpp"

namespace unicursal::host {

/// Turns the photo upright as its EXIF orientation says (CIPA DC-008, tag 0x0112). Throws core::FileError if
/// the file cannot be read, and core::DataError if it is not such a picture, is damaged, or has more than 200
/// million pixels.
Photo read_photo(const std::filesystem::path& file);

}  // namespace unicursal::host
