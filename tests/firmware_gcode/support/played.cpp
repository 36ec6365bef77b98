#include "tests/firmware_gcode/support/played.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace unicursal::gcode::test {

Played play(const std::vector<std::string>& lines) {
  Played played;
  std::array<double, 3> at{};
  double feed = 0, last_z = 0;
  int tool = -1;
  for (const std::string& line : lines) {
    if (line.empty() || line.front() == ';') continue;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word.front() == 'T') tool = std::atoi(word.c_str() + 1);
    if (word != "G1") {
      played.other.push_back(line);
      continue;
    }
    std::array<double, 3> to = at;
    double filament = 0;
    while (words >> word) {
      const double value = std::strtod(word.c_str() + 1, nullptr);
      switch (word.front()) {
        case 'X':
          to[0] = value;
          break;
        case 'Y':
          to[1] = value;
          break;
        case 'Z':
          to[2] = value;
          break;
        case 'E':
          filament = value;
          break;
        default:
          feed = value;
      }
    }
    const double way = std::hypot(to[0] - at[0], to[1] - at[1]);
    played.fed += filament;
    if (way > 0 && filament > 0) {
      played.beads.push_back({at, to, filament, feed, tool});
      last_z = to[2];
    }
    if (way > 10 && filament <= 0) played.lowest_travel = std::min(played.lowest_travel, to[2] - last_z);
    if (way == 0 && filament != 0) {
      played.drawn -= filament;
      played.drawing_tools.push_back(tool);
    }
    at = to;
  }
  return played;
}

}  // namespace unicursal::gcode::test
