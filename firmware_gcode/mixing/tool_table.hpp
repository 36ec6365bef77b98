// Assigns mixtures to virtual tools. If all mixtures of a print fit, each has a tool from the start. If there
// are more, the least recently used tool is redefined. The tool of equal shares, which draws filament back,
// is never redefined.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

class ToolTable {
 public:
  /// `dialect` must outlive this object. `equal_shares` is the mixture that draws filament back.
  ToolTable(const Dialect& dialect, const Palette& palette, const CalibratedMixture& equal_shares);

  /// The lines that define the tools at the start of the print.
  std::vector<std::string> define() const;
  /// Returns the tool that holds the mixture and marks it as used. Appends the lines that define it if
  /// needed.
  std::size_t use(const CalibratedMixture& mixture, std::vector<std::string>& lines);
  /// The tool of equal shares; absent if the mixtures of the print leave no tool for it.
  std::optional<std::size_t> retraction_tool() const { return retraction_tool_; }
  /// The mixture that a tool holds now.
  const CalibratedMixture& mixture(std::size_t tool) const;
  /// The number of tools, including the retraction tool.
  std::size_t size() const { return tools_.size() + (retraction_tool_ ? 1 : 0); }

 private:
  struct Tool {
    CalibratedMixture mixture;
    std::uint64_t used = 0;  ///< greater: later
  };

  const Dialect& dialect_;
  CalibratedMixture equal_shares_;
  std::vector<Tool> tools_;  ///< without the retraction tool
  std::optional<std::size_t> retraction_tool_;
  std::uint64_t uses_ = 0;
};

}  // namespace unicursal::gcode
