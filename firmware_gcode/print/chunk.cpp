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

void keep_commands(Chunk& chunk) {
  auto next = chunk.mixtures.begin();
  auto asked = chunk.asked.begin();
  std::size_t commands = 0;
  for (std::size_t line = 0; line < chunk.lines.size(); ++line) {
    for (; next != chunk.mixtures.end() && next->line == line; ++next) next->line = commands;
    for (; asked != chunk.asked.end() && asked->line == line; ++asked) asked->line = commands;
    commands += is_command(chunk.lines[line]) ? 1 : 0;
  }
  keep_commands(chunk.lines);
}

}  // namespace unicursal::gcode
