#include "firmware_gcode/sliced/retraction.hpp"

#include <algorithm>
#include <utility>

namespace unicursal::gcode {
namespace {

constexpr double rounding =
    1e-4;  ///< mm of filament that are pushed forward too far; the next bead gets them

}  // namespace

double Retraction::take(double filament, bool alone) {
  if (filament == 0) return 0;
  // A tool that was never used and is pushed forward first: the file counts for all tools together after all.
  if (std::exchange(new_tool_, false) && alone && filament > 0 && drawn_ == 0 && !others_.contains(tool_))
    drawn_ = std::min(before_, filament);
  drawn_ -= filament;
  if (drawn_ >= 0 || (alone && drawn_ > -rounding)) return 0;
  return -std::exchange(drawn_, 0);
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
