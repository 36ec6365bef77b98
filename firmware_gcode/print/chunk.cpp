#include "firmware_gcode/print/chunk.hpp"

#include <algorithm>

namespace unicursal::gcode {

void add(std::vector<MixtureVolume>& volumes, const Mixture& mixture, double volume) {
  const auto same =
      std::find_if(volumes.begin(), volumes.end(), [&](const auto& v) { return v.mixture == mixture; });
  if (same == volumes.end())
    volumes.push_back({mixture, volume});
  else
    same->volume += volume;
}

bool is_command(const std::string& line) {
  return !line.empty() && line.front() != ';';
}

void keep_commands(std::vector<std::string>& lines) {
  std::erase_if(lines, [](const std::string& line) { return !is_command(line); });
}

}  // namespace unicursal::gcode
