// The state of a printer that has run a print's lines up to some place: position, feed rate, tool, mixtures,
// modes, heat, fan, retraction. It understands the lines that this program writes. In a user's own lines it
// understands the words that mean the same in all firmwares and skips the rest. mm, mm/min, °C.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::gcode {

struct ModalState {
  using Lines = std::vector<std::string>;

  /// x y z as G-code counts them; absent before the first move of the axis and after homing.
  std::array<std::optional<double>, 3> position;
  double laid_top = 0;            ///< the greatest z at which plastic was laid
  bool relative = false;          ///< G91
  bool relative_filament = true;  ///< M83; every job sends it before it extrudes
  std::optional<double> feed;     ///< mm/min, from the last F
  std::optional<int> tool;
  std::map<int, Lines> tools;                    ///< the lines that defined each virtual tool
  double drawn_back = 0;                         ///< present retraction, mm of filament
  double nozzle = 0, bed = 0;                    ///< targets
  double fan = 0;                                ///< 0 … 255
  double speed_factor = 100, flow_factor = 100;  ///< per cent

  /// Runs one line (no number, no checksum).
  void run(std::string_view line);
  /// The M163 lines of a tool definition that is not complete yet.
  const Lines& collected() const { return collected_; }

 private:
  Lines collected_;  ///< M163 lines since the last M164
};

}  // namespace unicursal::gcode
