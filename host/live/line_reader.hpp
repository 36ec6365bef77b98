// What a printer does with a print's lines: how each moves the nozzle, what the feeders push meanwhile, and
// how long it takes. It reads the lines that this program writes, in all dialects; of a user's own lines it
// understands the words that mean the same in all firmwares and skips the rest. It repeats the arithmetic of
// firmwares in the simplest way: a mixture is normalised, M221 multiplies E, a feeder that slips feeds less
// (firmware_gcode/mixing/calibration.hpp). mm, mm³, s.
//
// It can be copied: the copy goes on from the same line.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/numeric/vec2.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

/// What a line does.
struct LineMotion {
  bool moves = false;     ///< an axis or the filament moves, so that it takes a place in the printer's queue
  bool travels = false;   ///< in the plane, between known places
  core::Vec2 from{0, 0};  ///< if it travels
  core::Vec2 to{0, 0};
  double volume = 0;   ///< that the feeders push; negative: draw back
  double seconds = 0;  ///< by length and feed rate; accelerations make it longer
};

class LineReader {
 public:
  explicit LineReader(const gcode::Printer& printer);

  /// Reads the next line (no number, no checksum).
  LineMotion read(std::string_view line);

  /// The nozzle's place; absent before the first move and after homing.
  std::optional<core::Vec2> place() const;
  std::optional<double> height() const { return position_[2]; }
  /// The shares of what the feeders push now.
  const gcode::Shares& fed() const { return fed_; }

 private:
  class Words;

  LineMotion move(const Words& words);
  void call_it(const Words& words);
  void home(const Words& words);
  void define(std::string_view text, int code);
  void mix(std::string_view text);
  void choose(const gcode::Shares& written);

  gcode::PerFeeder factors_;
  double filament_area_;                           ///< mm²
  std::array<std::optional<double>, 3> position_;  ///< x y z
  double filament_ = 0;                            ///< E, as far as it is absolute
  bool relative_ = false, relative_filament_ = false;
  double feed_ = 0;  ///< mm/s; 0: unknown
  double flow_percent_ = 100;
  gcode::Shares collected_;           ///< from M163, not stored yet
  std::vector<gcode::Shares> tools_;  ///< as written
  gcode::Shares fed_;
  double turned_ = 1;  ///< mm of filament that are fed for each mm of E
};

}  // namespace unicursal::host
