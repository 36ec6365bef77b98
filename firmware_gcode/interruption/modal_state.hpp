// What a printer that has run our lines up to some place is left in: position, feed rate, tool, mixtures,
// modes, heat, fan, filament. It understands the lines that this program writes; of a user's own lines those
// words that mean the same everywhere, and skips the rest. mm, mm/min, °C.
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

  /// x y z as G-code counts them; unknown until a line says where, and again after homing.
  std::array<std::optional<double>, 3> position;
  bool relative = false;          ///< G91
  bool relative_filament = true;  ///< M83, which every job says before it extrudes
  std::optional<double> feed;     ///< mm/min, of the last F
  std::optional<int> tool;
  std::map<int, Lines> tools;  ///< the lines that made each virtual tool
  double drawn_back = 0;       ///< mm of filament by which the last retraction has not been undone
  double nozzle = 0, bed = 0;  ///< targets
  double fan = 0;              ///< 0 … 255
  double speed_factor = 100, flow_factor = 100;  ///< per cent

  /// Runs one line (no number, no checksum).
  void run(std::string_view line);
  /// Shares that are told and belong to no tool yet: those of a definition that is begun.
  const Lines& collected() const { return collected_; }

 private:
  Lines collected_;  ///< M163 lines since the last mixture was stored
};

}  // namespace unicursal::gcode
