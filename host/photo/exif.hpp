// Which way up a photo is, from its EXIF data (CIPA DC-008-2019, 4.6.4: tag 0x0112 of the first directory).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "host/photo/photo.hpp"

namespace unicursal::host {

/// `tiff` begins with the header of TIFF, after "Exif\0\0" of a JPEG's segment. Returns 1 to 8; 1, upright,
/// if the data say nothing or are damaged.
int orientation_in(std::span<const std::uint8_t> tiff);

/// The photo turned and mirrored so that it is upright.
Photo upright(Photo photo, int orientation);

}  // namespace unicursal::host
