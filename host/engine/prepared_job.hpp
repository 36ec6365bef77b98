// A job that has been checked as far as possible without a printer: its settings and its part have been read,
// and the part lies on the bed and fits. mm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "core/model/part.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "host/engine/layer_range.hpp"
#include "host/job/job.hpp"
#include "host/lookahead/lookahead.hpp"

namespace unicursal::host {

struct PreparedJob {
  Job job;
  std::unique_ptr<const core::Part> part;
  std::shared_ptr<const core::IslandPlanner> planner;  ///< of the part's zones
  core::Vec2 offset{0, 0};                             ///< from the part's frame to the bed's
  std::size_t first = 0;                               ///< index of the first layer to print
  std::size_t count = 0;                               ///< number of layers to print
  std::optional<LayerRange> layers;                    ///< as asked; absent: all
  std::size_t threads = 0;                             ///< for planning; 0: one for each core
  double lowered = 0;       ///< distance that layers come down, so that the first one lies on the bed
  gcode::PrintFrame frame;  ///< on the bed
};

/// `layers`: print these only; absent: all. Throws core::DataError, for example if the part does not fit on
/// the bed or the range names no layer. `note` gets the warnings of job and part, also if a refusal follows.
/// A core::StopScope around it is obeyed.
PreparedJob prepare(Job job, const std::optional<LayerRange>& layers = {},
                    const std::function<void(const std::string&)>& note = {});

/// Throws core::DataError if the first layer is nowhere wide enough for a curve: the print would begin in the
/// air, or be empty.
void check_beginning(const PreparedJob& prepared);

/// The job's choices and the part's frame in one.
gcode::PrintSettings print_settings(const PreparedJob& prepared);
LookaheadOptions lookahead_options(const PreparedJob& prepared);

/// The layer's bead paths on the bed, thinned to the job's line width if it has one.
gcode::PlacedLayer placed(const PreparedJob& prepared, const PlannedLayer& planned);

}  // namespace unicursal::host
