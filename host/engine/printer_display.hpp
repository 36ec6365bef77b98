// What the printer's own display shows of a print: the layer, and the time of day at which the part will be
// ready. All firmwares show a text by M117: Marlin 2.1 (src/gcode/lcd/M117.cpp), Repetier (gcode.cpp,
// which keeps 20 characters), RepRapFirmware 3 (GCodes2.cpp). Marlin also takes per cent and minutes by M73
// P… R…, if it was built with SET_PROGRESS_MANUALLY, which Cap:BUILD_PERCENT shows (src/gcode/lcd/M73.cpp);
// a Marlin that lists no capabilities is tried once. Repetier has no M73; RepRapFirmware 3 reads M73 R, but
// shows it only for files that it prints itself (PrintMonitor.cpp).
//
// A printer that does not know a command is not asked again. No I/O: the session interposes these lines
// between two lines of the print, and passes on what the printer says.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/reply/identity.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

class PrinterDisplay {
 public:
  using WallTime = std::chrono::system_clock::time_point;

  struct Moment {
    TimePoint now;
    WallTime time_of_day;
  };
  struct Progress {
    double percent = 0;
    std::size_t layer = 0, layers = 0;  ///< counted from 1; 0: before the first
    std::optional<double> left;         ///< s
  };

  /// Until then, nothing is shown. `firmware`: the profile's name of it, for printers that do not name
  /// theirs.
  void begin(const gcode::Identity& printer, const std::string& firmware);

  /// Whether nothing can be due yet.
  bool rests(TimePoint now) const;
  /// The lines that show how far the print is, when the layer or the whole per cent has changed or a minute
  /// has passed, and not more often than every 10 s; empty otherwise.
  std::vector<std::string> due(const Progress& progress, const Moment& moment);
  /// The lines that show a word instead, until the next progress is due.
  std::vector<std::string> word(const std::string& text);
  /// "Done 13:42".
  std::vector<std::string> done(const Moment& moment);

  /// Takes a line from the printer into account; returns whether it only answers such a line, so that nobody
  /// needs to see it.
  bool hear(const std::string& line);

 private:
  std::vector<std::string> lines_for(const std::string& numbers, const std::string& text);

  bool shows_text_ = false, takes_numbers_ = false;
  std::optional<TimePoint> shown_at_;  ///< absent after a word
  std::size_t layer_ = 0;              ///< when it was shown
  long percent_ = 0;
  std::string numbers_, text_;  ///< that were sent last
};

}  // namespace unicursal::host
