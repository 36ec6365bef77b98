// What was laid, bead by bead, in the colours that arrived: a picture of each layer from above, and one of
// the whole part from a corner. The first layer's shows everything, the others and the part's are cropped
// alike to what lies above it, so that a prime line does not shrink the part. Each bead is as wide as its
// volume makes it, with a darker border, drawn in the order of printing: overlaps show as borders across
// older beads, gaps as background.
#pragma once

#include <filesystem>

#include "sim/bed/bead_store.hpp"

namespace unicursal::sim {

/// deposit-0000.png and so on. `pixel` mm; pixels grow where a side would exceed 4096 of them.
void draw_layers(BeadStore& store, const std::filesystem::path& folder, double pixel);

/// part.png: parallel projection from the front left corner, a third of a right angle above the bed.
void draw_part(BeadStore& store, const std::filesystem::path& folder);

/// Makes the folder and removes an older print's pictures from it. Throws std::system_error.
void clear_pictures(const std::filesystem::path& folder);

}  // namespace unicursal::sim
