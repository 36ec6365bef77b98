#include "firmware_gcode/sliced/retraction.hpp"

#include <algorithm>
#include <utility>

namespace unicursal::gcode {
namespace {

constexpr double rounding = 1e-7;  ///< mm of filament, of sums of E

}  // namespace

double Retraction::take(double filament, bool alone) {
  if (filament == 0) return 0;
  // A tool that was never used and is pushed forward first: the file counts for all tools together after all.
  if (std::exchange(new_tool_, false) && alone && filament > 0 && drawn_ == 0 && !others_.contains(tool_))
    drawn_ = std::min(before_, filament);
  const double drawn = drawn_ - filament;
  drawn_ = drawn > rounding ? drawn : 0;
  return -drawn > rounding ? -drawn : 0;
}

void Retraction::change_tool(int tool) {
  if (tool == tool_) return;
  others_[tool_] = drawn_;
  before_ = drawn_;
  const auto known = others_.find(tool);
  drawn_ = known == others_.end() ? 0 : known->second;
  new_tool_ = true;
  tool_ = tool;
}

}  // namespace unicursal::gcode
