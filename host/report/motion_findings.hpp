// How the simulated printer moved and pushed, from its own report, against the flow that the job asked for.
// mm, mm/s, mm³/s, s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

struct MotionFindings {
  static constexpr double tolerance = 0.05;   ///< of the nominal flow that still counts as constant
  static constexpr double hold_share = 0.95;  ///< of the seconds in which it should be held

  double nominal_flow = 0;
  double bead_seconds = 0;  ///< in which beads were laid
  double mean_speed = 0;    ///< of laying them
  /// Part of the seconds whose pushed volume was the nominal flow ± tolerance: what the melt feels.
  double seconds_in_tolerance = 0;
  /// The same for instants. Moves of a few tenths of a mm end on whole motor steps, which alone makes their
  /// flows differ by some percent from one to the next.
  double instants_in_tolerance = 0;
  double mean_flow = 0;
  /// An estimate of the flow, no more than the nominal one, that would be held in hold_share of the seconds.
  /// What the slowest of them lack is taken to grow with the third power of the flow: corners cost the more,
  /// the faster they are come to. Where it was measured (a plate with folds 0.45 mm apart) it was the 3.8th.
  double holdable_flow = 0;
  std::uint64_t starvations = 0;  ///< the queue ran dry in mid-curve
  std::uint64_t hasty_stops = 0;  ///< the next move came while the last one was already braking
  double stopped_seconds = 0;
  std::uint64_t travels = 0;
  double travel = 0;
};

/// `simulator` is the report of sim; what it lacks counts as zero.
MotionFindings motion_findings(const nlohmann::json& simulator, double nominal_flow);

nlohmann::json to_json(const MotionFindings& findings);

}  // namespace unicursal::host
