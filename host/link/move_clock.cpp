#include "host/link/move_clock.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace unicursal::host {
namespace {

constexpr std::string_view letters = "XYZE";
constexpr std::size_t filament = 3;
constexpr double shortest = 0.02;  ///< s; Marlin stretches shorter moves while few are queued

/// The number behind a letter that begins a word; absent if there is none.
std::optional<double> word(std::string_view words, char letter) {
  for (std::size_t at = words.find(letter); at != std::string_view::npos; at = words.find(letter, at + 1)) {
    if (at > 0 && words[at - 1] != ' ') continue;
    double value = 0;
    const auto [end, error] =
        std::from_chars(words.data() + at + 1, words.data() + words.size(), value, std::chars_format::fixed);
    if (error == std::errc() && std::isfinite(value)) return value;
  }
  return std::nullopt;
}

/// Commands that only change a value, in Marlin. They wait behind moves like everything, but take no time.
bool is_quick(char letter, int code) {
  if (letter == 'T') return true;
  if (letter == 'G') return code == 90 || code == 91 || code == 92;
  switch (code) {
    case 73:
    case 82:
    case 83:
    case 85:
    case 104:
    case 105:
    case 106:
    case 107:
    case 117:
    case 140:
    case 155:
    case 163:
    case 164:
    case 165:
    case 220:
    case 221:
      return letter == 'M';
    default:
      return false;
  }
}

}  // namespace

std::optional<double> MoveClock::seconds(std::string_view line) {
  if (line.empty()) return 0;
  int code = -1;
  const auto [end, error] = std::from_chars(line.data() + 1, line.data() + line.size(), code);
  if (error != std::errc()) return std::nullopt;
  const char letter = line.front();
  const std::string_view words = line.substr(static_cast<std::size_t>(end - line.data()));
  const auto is = [&](char which, int number) { return letter == which && code == number; };
  if (is('G', 0) || is('G', 1)) return move(words);
  if (is('G', 90) || is('G', 91)) relative_ = relative_filament_ = code == 91;
  if (is('M', 82) || is('M', 83)) relative_filament_ = code == 83;
  if (is('M', 220)) speed_percent_ = std::max(word(words, 'S').value_or(speed_percent_), 1.0);
  for (std::size_t i = 0; is('G', 92) && i < letters.size(); ++i) {
    if (const auto to = word(words, letters[i])) position_[i] = to;
  }
  if (is_quick(letter, code)) return 0;
  if (letter == 'G') position_ = {};
  return std::nullopt;
}

std::optional<double> MoveClock::move(std::string_view words) {
  if (const auto feed = word(words, 'F'); feed && *feed > 0) feed_ = feed;
  double squares = 0, fed = 0;
  bool known = feed_.has_value();
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const auto to = word(words, letters[i]);
    if (!to) continue;
    const bool relative = i == filament ? relative_filament_ : relative_;
    known = known && (relative || position_[i]);
    const double way = relative ? *to : *to - position_[i].value_or(0);
    if (relative && position_[i])
      *position_[i] += way;
    else if (!relative)
      position_[i] = to;
    if (i == filament)
      fed = std::abs(way);
    else
      squares += way * way;
  }
  if (!known) return std::nullopt;
  const double way = squares > 0 ? std::sqrt(squares) : fed;
  return std::max(way / (*feed_ / 60 * speed_percent_ / 100), shortest);
}

}  // namespace unicursal::host
