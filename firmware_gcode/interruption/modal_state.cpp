#include "firmware_gcode/interruption/modal_state.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace unicursal::gcode {
namespace {

/// "G1", "M104", "T2": a letter and a number, and the words behind them.
struct Command {
  char letter = 0;
  int code = -1;
  std::string_view words;

  bool is(char which, int number) const { return letter == which && code == number; }
};

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Command command_in(std::string_view line) {
  Command command;
  if (line.empty()) return command;
  const std::string_view rest = line.substr(1);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), command.code);
  if (error != std::errc()) return {};
  command.letter = line.front();
  command.words = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return command;
}

/// Finds the word that begins with the letter; words are separated by spaces.
std::optional<std::string_view> word(std::string_view words, char letter) {
  for (auto at = words.find(' '); at != std::string_view::npos; at = words.find(' ', at + 1)) {
    if (at + 1 < words.size() && words[at + 1] == letter) return words.substr(at + 2);
  }
  return std::nullopt;
}

std::optional<double> value(const Command& command, char letter) {
  const auto text = word(command.words, letter);
  return text ? number_in(*text) : std::nullopt;
}

constexpr double most_tools = 255;  ///< of any firmware; greater numbers are ignored

constexpr int mixing_tool = 0;  ///< RepRapFirmware's tool, whose shares M567 rewrites

constexpr std::array<char, 3> axes{'X', 'Y', 'Z'};

void move(ModalState& state, const Command& command) {
  if (const auto feed = value(command, 'F')) state.feed = feed;
  bool travels = false;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto to = value(command, axes[i]);
    if (!to) continue;
    travels = true;
    auto& coordinate = state.position[i];
    if (!state.relative)
      coordinate = to;
    else if (coordinate)
      *coordinate += *to;
  }
  const auto filament = value(command, 'E');
  if (filament && *filament > 0 && travels)
    state.laid_top = std::max(state.laid_top, state.position[2].value_or(0));
  if (!filament || travels || !state.relative_filament) return;
  state.drawn_back = std::max(0.0, state.drawn_back - *filament);
}

/// Positions are unknown after homing, since the places of the end switches are.
void home(ModalState& state, const Command& command) {
  const bool some =
      std::any_of(axes.begin(), axes.end(), [&](char axis) { return word(command.words, axis).has_value(); });
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!some || word(command.words, axes[i])) state.position[i].reset();
  }
}

void call_it(ModalState& state, const Command& command) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (const auto to = value(command, axes[i])) state.position[i] = to;
  }
}

void run_g(ModalState& state, const Command& command) {
  switch (command.code) {
    case 0:
    case 1:
    case 2:
    case 3:
      return move(state, command);
    case 28:
      return home(state, command);
    case 90:
    case 91:
      // In Marlin, both also change the mode of the filament.
      state.relative = state.relative_filament = command.code == 91;
      return;
    case 92:
      return call_it(state, command);
    default:
      return;
  }
}

void run_m(ModalState& state, const Command& command) {
  const auto s = value(command, 'S');
  switch (command.code) {
    case 82:
    case 83:
      state.relative_filament = command.code == 83;
      return;
    case 104:
    case 109:
      if (const auto target = s ? s : value(command, 'R')) state.nozzle = *target;
      return;
    case 140:
    case 190:
      if (const auto target = s ? s : value(command, 'R')) state.bed = *target;
      return;
    case 106:
      state.fan = s.value_or(255);
      return;
    case 107:
      state.fan = 0;
      return;
    case 220:
      state.speed_factor = s.value_or(state.speed_factor);
      return;
    case 221:
      state.flow_factor = s.value_or(state.flow_factor);
      return;
    default:
      return;
  }
}

}  // namespace

void ModalState::run(std::string_view line) {
  const Command command = command_in(line);
  if (command.letter == 'T') tool = command.code;
  if (command.letter == 'G') run_g(*this, command);
  if (command.letter != 'M') return;
  run_m(*this, command);
  if (command.code == 567 && word(command.words, 'E')) tools[mixing_tool] = {std::string(line)};
  if (command.code == 163) collected_.emplace_back(line);
  if (command.code != 164) return;
  Lines lines = std::exchange(collected_, {});
  lines.emplace_back(line);
  const auto stored = value(command, 'S');
  if (stored && *stored >= 0 && *stored <= most_tools) tools[static_cast<int>(*stored)] = std::move(lines);
}

}  // namespace unicursal::gcode
