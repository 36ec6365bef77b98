#include "host/link/whereabouts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace unicursal::host {
namespace {

constexpr double same = 0.0015;  ///< mm; places are written and reported with three decimals

struct Words {
  std::string_view name;
  std::array<std::optional<double>, 3> axes;
  bool filament = false;
};

Words words_of(std::string_view command) {
  Words words;
  words.name = command.substr(0, command.find(' '));
  for (auto at = command.find(' '); at != std::string_view::npos; at = command.find(' ', at + 1)) {
    const std::string_view word = command.substr(at + 1, command.find(' ', at + 1) - at - 1);
    if (word.empty()) continue;
    const auto axis = std::string_view("XYZ").find(word.front());
    double value = 0;
    if (word.front() == 'E') words.filament = true;
    if (axis == std::string_view::npos) continue;
    const auto [end, error] = std::from_chars(word.data() + 1, word.data() + word.size(), value);
    if (error == std::errc()) words.axes[axis] = value;
  }
  return words;
}

bool is_move(const Words& words) {
  return words.name == "G0" || words.name == "G1";
}

/// Whether a line that moves nothing does the same when it is done again.
bool is_repeatable(std::string_view name) {
  constexpr std::array lines{"G4",   "G21",  "G28",  "G90",  "G92",  "M82",  "M83",  "M84",  "M85",
                             "M92",  "M104", "M105", "M106", "M107", "M109", "M110", "M114", "M115",
                             "M117", "M140", "M190", "M220", "M221", "M400", "M563", "M567", "M568"};
  return name.starts_with('T') || std::find(lines.begin(), lines.end(), name) != lines.end();
}

}  // namespace

void Whereabouts::done(std::string_view command) {
  const Words words = words_of(command);
  if (words.name == "G90" || words.name == "G91") relative_ = words.name == "G91";
  const bool some =
      std::any_of(words.axes.begin(), words.axes.end(), [](const auto& to) { return bool(to); });
  for (std::size_t axis = 0; axis < place_.size(); ++axis) {
    const auto& to = words.axes[axis];
    if (words.name == "G28" && (to || !some)) place_[axis].reset();
    if (words.name == "G92" && to) place_[axis] = to;
    if (!is_move(words) || !to) continue;
    if (!relative_)
      place_[axis] = to;
    else if (place_[axis])
      *place_[axis] += *to;
  }
  if (words.name == "G28" && !some) place_ = {};
}

Whereabouts::Verdict Whereabouts::judge(std::string_view command, const std::array<double, 3>& place) const {
  const Words words = words_of(command);
  if (!is_move(words)) return is_repeatable(words.name) ? Verdict::repeatable : Verdict::unknown;
  bool moves = false, before = true, behind = true;
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    const auto& to = words.axes[axis];
    if (!to) continue;
    if (relative_) return Verdict::unknown;
    const auto& from = place_[axis];
    moves = moves || (from && std::abs(*to - *from) > same);
    before = before && from && std::abs(place[axis] - *from) <= same;
    behind = behind && std::abs(place[axis] - *to) <= same;
  }
  if (moves && behind != before) return behind ? Verdict::done : Verdict::repeatable;
  return moves || words.filament ? Verdict::unknown : Verdict::repeatable;
}

}  // namespace unicursal::host
