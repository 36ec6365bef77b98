// Which virtual tool holds which mixture. As long as all mixtures of a print fit, each has a tool of its own
// from the start; when there are more, the tool that has not been used for longest is given another one. The
// tool of equal shares, for drawing back, keeps its place.
#pragma once

#include <array>
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
  /// `dialect` must outlive this object. `factors`: of feeders that slip (calibration.hpp).
  ToolTable(const Dialect& dialect, const Palette& palette, const std::array<double, max_feeders>& factors);

  /// The lines that define what is known from the start.
  std::vector<std::string> define() const;
  /// The tool that holds the mixture, now in use; appends what it takes to define it, if need be.
  std::size_t use(const Mixture& mixture, std::vector<std::string>& lines);
  /// Of equal shares; none where the mixtures of the print leave no tool for it.
  std::optional<std::size_t> retraction_tool() const { return retraction_tool_; }
  /// E ÷ the filament that is to be fed.
  double scale(std::size_t tool) const;

 private:
  struct Tool {
    Mixture mixture;
    std::uint64_t used = 0;  ///< the greater, the later
  };

  WrittenTool written(const Mixture& mixture) const { return calibrated(mixture, factors_, dialect_); }

  const Dialect& dialect_;
  std::array<double, max_feeders> factors_;
  std::vector<Tool> tools_;  ///< without the one for drawing back
  std::optional<std::size_t> retraction_tool_;
  std::uint64_t uses_ = 0;
};

}  // namespace unicursal::gcode
