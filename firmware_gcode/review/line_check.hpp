// The last look at finished lines before they are handed out: a small interpreter of the program's own G-code
// that knows nothing of how the lines were made. What it refuses is a defect of the program, which a printer
// is not to suffer from. mm, mm/s, mm³/s, °C.
//
// It holds every line to: a command that this program writes, short enough and plain; every position on the
// bed; no axis above its speed; no more flow than the extruder melts, over any half millimetre; no move that
// feeds more than the firmware takes; filament drawn back no further than the profile says, and out again;
// beads only from a known place, warm, with a tool that has been defined by all feeders, none of them all
// zero; heaters within what they may. The user's own lines (job_frame.hpp) are passed over.
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

/// What lines make the machine do.
struct MoveListener {
  std::function<void(const PerAxis& displacement, double speed)> move;
  std::function<void()> stop;  ///< all motion ends before what follows
};

class LineCheck {
 public:
  LineCheck(const Printer& printer, const Dialect& dialect);

  /// Reads the lines of the next chunk and tells what they do. `place` begins messages: "layer 3". Throws
  /// core::DataError, and is then as it was before, though the listener has heard of the lines up to there.
  void read(const Chunk& chunk, const std::string& place, const MoveListener& listener);

 private:
  class Words;

  /// What a firmware remembers, as far as lines depend on it.
  struct State {
    std::array<std::optional<double>, 3> at;  ///< x y z, absent: unknown
    double feed = 0;                          ///< mm/s, 0: unknown
    bool relative_filament = false;
    std::optional<std::size_t> tool;
    std::set<std::size_t> defined;
    std::array<std::optional<double>, 3> shares;               ///< collected
    double nozzle = 0;                                         ///< °C asked for
    double drawn = 0;                                          ///< mm that the filament is drawn back
    double flow_way = 0, flow_seconds = 0, flow_filament = 0;  ///< since the flow was last looked at
    bool user = false;                                         ///< between the user's comments
  };

  void command(const std::string& line, const MoveListener& listener);
  void move(const Words& words, const MoveListener& listener);
  void check_speed(const PerAxis& displacement, double length) const;
  void feed_filament(double filament, double length);
  void check_flow();
  void define(const Words& words);
  void set_tool(const Words& words, const MoveListener& listener);
  void forget();
  void heat(const Words& words, double greatest, double* target);

  Printer printer_;
  const Dialect& dialect_;
  double filament_area_;                   ///< mm²
  double least_factor_, greatest_factor_;  ///< by which filament may be written longer than it is
  State state_;
};

}  // namespace unicursal::gcode
