// The final check of finished lines before they are handed out: a small interpreter of the program's own
// G-code that does not know how the lines were made. A line that it refuses is a defect of the program, from
// which the printer must be protected. mm, mm/s, mm³/s, °C.
//
// It requires of every line: a command that this program writes, short and plain; positions on the bed;
// speeds within the limits of all axes; no more flow than the extruder melts, over any half millimetre; no
// more filament in one move than the firmware accepts; retractions no longer than the profile's, and undone
// before the next bead; beads that start from a known place, warm, with a defined tool whose shares are not
// all zero, and add up to one where the firmware does not normalise them; heater targets within their limits.
// It skips the user's own lines (dialect/common_lines.hpp).
//
// The simulator parses G-code on its own (sim/firmware, sim/line/line_check.hpp) on purpose: it is
// independent, so that a mistake in one of them cannot hide in the other.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/motion/junction.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Receives the motion that lines cause.
struct MoveListener {
  std::function<void(const PerAxis& displacement, double speed)> move;
  std::function<void()> stop;  ///< all motion ends here
};

class LineCheck {
 public:
  LineCheck(const Printer& printer, const Dialect& dialect);

  /// Reads the lines of the next chunk and reports their motion. Messages begin with `place`, such as "layer
  /// 3". Throws core::DataError and then keeps its state, although the listener has received the lines up to
  /// there.
  void read(const Chunk& chunk, const std::string& place, const MoveListener& listener);

 private:
  class Words;

  /// The state of a firmware, as far as lines depend on it.
  struct State {
    std::array<std::optional<double>, 3> at;  ///< x y z; absent if unknown
    double feed = 0;                          ///< mm/s, 0: unknown
    bool relative_filament = false;
    std::optional<std::size_t> tool;
    std::set<std::size_t> defined;
    bool extruder_chosen = false;                              ///< only where the firmware needs it
    std::array<std::optional<double>, most_feeders> shares;    ///< from M163, not stored yet
    double nozzle = 0;                                         ///< target, °C
    double drawn = 0;                                          ///< retraction of the filament, mm
    double flow_way = 0, flow_seconds = 0, flow_filament = 0;  ///< since the flow was last checked
    bool user = false;                                         ///< inside the user's own lines
  };

  void command(const std::string& line, const MoveListener& listener);
  void move(const Words& words, const MoveListener& listener);
  void check_speed(const PerAxis& displacement, double length) const;
  void feed_filament(double filament, double length);
  void check_flow();
  void define(const Words& words);
  void mix(std::string_view line);
  void set_tool(const Words& words, const MoveListener& listener);
  void forget();
  void heat(const Words& words, double greatest, double* target);

  Printer printer_;
  const Dialect& dialect_;
  double filament_area_;                   ///< mm²
  double least_factor_, greatest_factor_;  ///< of the scale between written and real filament
  State state_;
};

}  // namespace unicursal::gcode
