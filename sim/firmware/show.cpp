// M117 and M73, which take effect when their turn comes and wait for no move.
//
// Marlin (src/gcode/lcd/M117.cpp, M73.cpp, class MarlinUI): everything behind M117 up to an asterisk is the
// text, in which a semicolon needs a backslash; 63 bytes are kept. A build that prompts through the host
// sends each text back as a notification. M73 exists with SET_PROGRESS_MANUALLY only (Cap:BUILD_PERCENT).
//
// Repetier (gcode.cpp, class UIDisplay): the same, 20 characters; M73 is unknown.
//
// RepRapFirmware 3 (GCodes2.cpp, StringParser.cpp, PrintMonitor.cpp): the text may stand in quotes, 120
// characters; of M73 only R is read, which nobody sees unless the firmware prints a file.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

namespace {

constexpr double most_percent = 100;

std::string_view text_behind(std::string_view line) {
  line.remove_prefix(std::min(line.find("117"), line.size()));
  line.remove_prefix(std::min<std::size_t>(3, line.size()));
  line = line.substr(0, line.find('*'));
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string without_quotes(std::string_view text) {
  if (!text.starts_with('"')) return std::string(text);
  std::string inside;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"' && (i + 1 == text.size() || text[++i] != '"')) break;
    inside += text[i];
  }
  return inside;
}

/// A character of several bytes is not cut.
std::string cut(std::string text, std::size_t longest) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };
  while (text.size() > longest) {
    while (continues(text.back())) text.pop_back();
    text.pop_back();
  }
  return text;
}

}  // namespace

void Firmware::show_text(const Command&) {
  const std::string_view raw = text_behind(queue_.front().body);
  const bool quotes = personality_.family == Personality::Family::reprapfirmware;
  const std::string text = quotes ? without_quotes(raw) : std::string(raw);
  screen_.text = cut(text, personality_.longest_text);
  ++screen_.texts;
  if (personality_.host_prompts && !text.empty()) say("//action:notification " + text);
}

void Firmware::set_progress(const Command& command) {
  if (const auto left = command.value('R')) screen_.minutes_left = std::floor(std::max(*left, 0.0));
  const auto percent = command.value('P');
  if (percent && personality_.family == Personality::Family::marlin)
    screen_.percent = std::clamp(std::floor(*percent), 0.0, most_percent);
}

}  // namespace unicursal::sim
