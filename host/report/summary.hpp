// The results of a plan, a print or a dry run in a few lines for a terminal.
#pragma once

#include <string>

#include "host/lookahead/planned_layer.hpp"
#include "host/report/deposit_findings.hpp"
#include "host/report/motion_findings.hpp"
#include "host/report/totals.hpp"

namespace unicursal::host {

/// A line about beads outside the profile's bead_width_range; empty if there are none.
std::string odd_widths(const Figures& figures);

/// "2 h 05 min", "3 min 20 s", "12.4 s"
std::string duration_words(double seconds);

/// Layers, curves, material and times, a line each.
std::string summary(const RunTotals& totals, const PlanningEffort& planning);

/// Lines and volumes by the simulator's count.
std::string summary(const Comparison& comparison);

/// Gaps, heights and mixtures of what was laid.
std::string summary(const DepositFindings& deposit);

/// Speed, flow, travels and starvations.
std::string summary(const MotionFindings& motion);

}  // namespace unicursal::host
