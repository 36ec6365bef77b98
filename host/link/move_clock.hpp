// How long a line keeps a printer busy that plans moves ahead, by its distance and feed rate. A firmware that
// has been given lines for a known time and is then silent has lost an ok or a line. An estimate: junctions
// and accelerations make moves longer. mm, mm/min, s. No I/O.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace unicursal::host {

class MoveClock {
 public:
  /// Takes the next line (no number, no checksum). Returns the s that it takes to run; 0: it takes no time;
  /// absent: it may take any time, such as homing, or the way is not known.
  std::optional<double> seconds(std::string_view line);

 private:
  std::optional<double> move(std::string_view words);

  std::array<std::optional<double>, 4> position_;  ///< x y z e
  std::optional<double> feed_;
  double speed_percent_ = 100;
  bool relative_ = false, relative_filament_ = false;
};

}  // namespace unicursal::host
