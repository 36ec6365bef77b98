// Pictures of the deposit, bead by bead, in the colours that arrived: each layer from above, and the whole
// part from a corner. All are cropped to the extents of the part, so that a prime line does not shrink it.
// Each bead has the width that follows from its volume, and a darker border. Beads are drawn in the order of
// printing: overlaps show as borders across older beads, gaps as background.
#pragma once

#include <filesystem>

#include "sim/bed/bead_store.hpp"

namespace unicursal::sim {

/// Where the pictures of layers lie on the bed, mm: their upper left corner, and the side of a pixel.
struct PicturePlace {
  double left = 0, top = 0, pixel = 0;
};
PicturePlace place_of_layers(const BeadStore& store, double pixel);

/// Draws deposit-0000.png and so on. `pixel` is in mm; it grows if a side would exceed 4096 pixels.
void draw_layers(BeadStore& store, const std::filesystem::path& folder, double pixel);

/// Draws part.png: parallel projection from the front left corner, 30° above the bed.
void draw_part(BeadStore& store, const std::filesystem::path& folder);

/// Makes the folder and removes the pictures of an older print from it. Throws std::system_error.
void clear_pictures(const std::filesystem::path& folder);

}  // namespace unicursal::sim
