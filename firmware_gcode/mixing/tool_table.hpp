// Which virtual tool holds which mixture. As long as all mixtures of a print fit, each has a tool of its own
// from the start; when there are more, the tool that has not been used for longest is given another one. The
// tool of equal shares, for drawing back, keeps its place.
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
  /// `dialect` must outlive this object. `equal_shares`: for drawing back.
  ToolTable(const Dialect& dialect, const Palette& palette, const CalibratedMixture& equal_shares);

  /// The lines that define what is known from the start.
  std::vector<std::string> define() const;
  /// The tool that holds the mixture, now in use; appends what it takes to define it, if need be.
  std::size_t use(const CalibratedMixture& mixture, std::vector<std::string>& lines);
  /// Of equal shares; none where the mixtures of the print leave no tool for it.
  std::optional<std::size_t> retraction_tool() const { return retraction_tool_; }
  /// What a tool holds now.
  const CalibratedMixture& mixture(std::size_t tool) const;
  /// Tools in use, the one for drawing back included.
  std::size_t size() const { return tools_.size() + (retraction_tool_ ? 1 : 0); }

 private:
  struct Tool {
    CalibratedMixture mixture;
    std::uint64_t used = 0;  ///< the greater, the later
  };

  const Dialect& dialect_;
  CalibratedMixture equal_shares_;
  std::vector<Tool> tools_;  ///< without the one for drawing back
  std::optional<std::size_t> retraction_tool_;
  std::uint64_t uses_ = 0;
};

}  // namespace unicursal::gcode
