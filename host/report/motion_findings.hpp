// Motion and flow of the simulated printer, from its own report, compared with the flow that the job asked
// for. mm, mm/s, mm³/s, s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

struct MotionFindings {
  static constexpr double tolerance =
      0.05;  ///< deviation from the nominal flow that still counts as constant
  static constexpr double hold_share = 0.95;  ///< fraction of the seconds in which it should be held

  double nominal_flow = 0;
  double bead_seconds = 0;  ///< time in which beads were laid
  double mean_speed = 0;    ///< while beads were laid
  /// Fraction of the seconds whose extruded volume was the nominal flow ± tolerance.
  double seconds_in_tolerance = 0;
  /// The same for instants. Moves of a few tenths of a mm end on whole motor steps, which alone makes their
  /// flows differ by some per cent.
  double instants_in_tolerance = 0;
  double mean_flow = 0;
  /// Estimate of the flow, at most the nominal one, that would be held in hold_share of the seconds. The
  /// slowest seconds are assumed to fall short in proportion to the third power of the flow, since fast
  /// corners cost more. A plate with folds 0.45 mm apart was measured to follow the power 3.8.
  double holdable_flow = 0;
  std::uint64_t starvations = 0;  ///< times that the queue ran dry in the middle of a curve
  std::uint64_t hasty_stops = 0;  ///< times that a move came while the last one was already braking
  double stopped_seconds = 0;
  std::uint64_t travels = 0;
  double travel = 0;
};

/// `simulator`: the report of the simulator; missing numbers count as zero.
MotionFindings motion_findings(const nlohmann::json& simulator, double nominal_flow);

nlohmann::json to_json(const MotionFindings& findings);

}  // namespace unicursal::host
