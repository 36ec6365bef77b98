// Pictures of how a curve was made, one for each stage of the paper's Figure 2, and of the widths of its
// beads. mm in, pixels out.
#pragma once

#include <filesystem>

#include "core/planner/stages.hpp"
#include "host/report/curve_picture.hpp"

namespace unicursal::host {

/// One island with the results of every stage.
struct IslandStory {
  const core::Island& island;
  const core::Stages& stages;
  const core::IslandPlan& plan;
};

/// Writes into the folder, which must exist: 1-field.png (strokes along the asked directions; dots where none
/// is asked), 2-graph.png (cells and needles), 3-first-cycle.png, 4-optimised-cycle.png, 5-curve.png (in the
/// mixtures) and 6-width.png (width of the beads ÷ the asked one: blue below, red above). All of one size.
/// `style.extent` is ignored: the island fills the picture. Throws std::system_error.
void write_stage_pictures(const std::filesystem::path& folder, const IslandStory& story,
                          const CurveStyle& style);

/// The colour of a bead `ratio` times as wide as asked: pale at 1, blue below, red above.
picture::Colour width_colour(double ratio);

}  // namespace unicursal::host
