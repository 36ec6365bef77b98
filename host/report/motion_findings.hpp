// How the simulated printer moved and pushed, from its own report, against the flow that the job asked for.
// mm, mm/s, mm³/s, s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

struct MotionFindings {
  static constexpr double tolerance = 0.05;   ///< of the nominal flow that still counts as constant
  static constexpr double hold_share = 0.95;  ///< of the time that it should be held for

  double nominal_flow = 0;
  double bead_seconds = 0;  ///< in which beads were laid
  double mean_speed = 0;    ///< of laying them
  double in_tolerance =
      0;  ///< part of bead_seconds at every instant of which the flow was nominal ± tolerance
  double seconds_in_tolerance = 0;  ///< the same for the flow averaged over each second
  double mean_flow = 0;
  /// The greatest flow, no more than the nominal one, that this curve and machine would hold for that share
  /// of the time at every instant: what passes where they are slowest counts. An estimate from this run.
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
