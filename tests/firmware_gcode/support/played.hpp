// Plays the lines of a remixed print as a firmware would, with as little code as that takes, and reports the
// beads. mm, mm/min.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace unicursal::gcode::test {

struct PlayedBead {
  std::array<double, 3> from{}, to{};
  double filament = 0, feed = 0;
  int tool = -1;
};

struct Played {
  std::vector<PlayedBead> beads;   ///< moves that feed and go somewhere
  double fed = 0;                  ///< mm of filament, what was drawn back subtracted
  double drawn = 0;                ///< mm, at the end
  std::vector<int> drawing_tools;  ///< tools that were in use when filament was drawn back or pushed forward
  double lowest_travel = 1e9;      ///< mm, of moves of more than 10 mm that lay nothing, below the last bead
  std::vector<std::string> other;  ///< lines that are not moves
};

/// Only G1, G90, M83, G92 E0, T and lines of other commands are understood, since nothing else may occur.
Played play(const std::vector<std::string>& lines);

}  // namespace unicursal::gcode::test
