#include "firmware_gcode/review/line_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/print/bounds.hpp"

namespace unicursal::gcode {
namespace {

constexpr std::size_t numbering = 15;         ///< characters for line number and checksum
constexpr double place_tolerance = 5e-4;      ///< mm; rounding of a position
constexpr double speed_tolerance = 0.02;      ///< relative; a feed rate is kept if it is within 1 %
constexpr double feed_rounding = 0.02;        ///< mm/s; feed rates are whole mm/min
constexpr double flow_tolerance_here = 0.05;  ///< relative; feed rates, positions and E are rounded
constexpr double flow_span = 0.5;             ///< mm over which the flow is averaged
constexpr double rounding = 1e-3;  ///< mm of filament that rounding may carry over to the next bead
constexpr double share_tolerance = 1e-6;
constexpr const char* axes = "XYZ";

/// The problem of a line; becomes a core::DataError when its place is known.
struct Fault {
  std::string problem;
};

void require(bool good, const char* problem) {
  if (!good) throw Fault{problem};
}

}  // namespace

/// A command and its letters, each at most once.
class LineCheck::Words {
 public:
  explicit Words(std::string_view line) {
    const std::size_t end = std::min(line.find(' '), line.size());
    command = line.substr(0, end);
    for (line.remove_prefix(end); !line.empty();) {
      line.remove_prefix(1);
      const std::size_t stop = std::min(line.find(' '), line.size());
      add(line.substr(0, stop));
      line.remove_prefix(stop);
    }
  }

  std::optional<double> find(char letter) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (letters_[i] == letter) return numbers_[i];
    }
    return std::nullopt;
  }
  double at(char letter) const {
    const auto value = find(letter);
    if (!value) throw Fault{fmt::format("{} is missing", letter)};
    return *value;
  }
  bool only(std::string_view letters) const {
    return std::all_of(letters_.begin(), letters_.begin() + count_,
                       [&](char l) { return letters.find(l) != std::string_view::npos; });
  }

  std::string_view command;

 private:
  void add(std::string_view word) {
    require(word.size() >= 2 && count_ < letters_.size(), "it has an empty word, or too many");
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto result = std::from_chars(word.data() + 1, end, value);
    require(result.ec == std::errc() && result.ptr == end && std::isfinite(value),
            "a word has no valid number");
    require(!find(word[0]), "a letter comes twice");
    letters_[count_] = word[0];
    numbers_[count_++] = value;
  }

  std::array<char, 6> letters_{};
  std::array<double, 6> numbers_{};
  std::size_t count_ = 0;
};

LineCheck::LineCheck(const Printer& printer, const Dialect& dialect)
    : printer_(printer),
      dialect_(dialect),
      filament_area_(std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter),
      least_factor_(*std::min_element(printer.flow_factors.begin(), printer.flow_factors.end())),
      greatest_factor_(*std::max_element(printer.flow_factors.begin(), printer.flow_factors.end())) {
  state_.drawn = printer_.retraction_length;
}

void LineCheck::read(const Chunk& chunk, const std::string& place, const MoveListener& listener) {
  const State before = state_;
  std::size_t number = 0;
  try {
    for (const std::string& line : chunk.lines) {
      ++number;
      if (line == user_lines_begin) state_.user = true;
      if (line == user_lines_end) {
        state_.user = false;
        forget();
      }
      if (line.empty() || line.front() == ';' || state_.user) continue;
      command(line, listener);
    }
  } catch (const Fault& fault) {
    state_ = before;
    throw core::DataError("", fmt::format("{}, line {} (\"{}\")", place, number, chunk.lines[number - 1]),
                          fault.problem + "; nothing of it was sent",
                          "this is a defect of the program; please report it");
  }
}

void LineCheck::forget() {
  state_.at = {};
  state_.feed = 0;
  state_.tool.reset();
  state_.extruder_chosen = false;
  state_.relative_filament = false;
  state_.shares = {};
}

void LineCheck::command(const std::string& line, const MoveListener& listener) {
  require(line.size() + numbering <= dialect_.limits().line_length, "it is too long");
  require(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~' && c != '*'; }),
          "it contains a character that is not allowed");
  if (line.starts_with("M567 ")) return mix(line);
  const Words words(line);
  const std::string_view name = words.command;
  require(!name.empty(), "it begins with a space");
  static const std::vector<std::string_view> harmless = {"G21",  "G92",  "M84",  "M85",  "M92",
                                                         "M106", "M107", "M220", "M221", "M400"};
  if (name == "G0" || name == "G1") return move(words, listener);
  if (name == "M163" || name == "M164") return define(words);
  if (name.front() == 'T') return set_tool(words, listener);
  if (name == "M104" || name == "M109")
    return heat(words, bounds::nozzle_temperature.greatest, &state_.nozzle);
  if (name == "M140" || name == "M190") return heat(words, bounds::bed_temperature.greatest, nullptr);
  if (name == "G28") state_.at = {};
  if (name == "G90") state_.relative_filament = false;  // overrides M83
  if (name == "M83") state_.relative_filament = true;
  if (name == "G28" || name == "M400") listener.stop();
  const bool known = name == "G28" || name == "G90" || name == "M83" ||
                     std::find(harmless.begin(), harmless.end(), name) != harmless.end();
  require(known, "this program does not write such a command");
}

void LineCheck::heat(const Words& words, double greatest, double* target) {
  const double asked = words.at('S');
  require(words.only("S") && asked >= 0 && asked <= greatest, "it is hotter than this heater may get");
  if (target) *target = asked;
}

void LineCheck::define(const Words& words) {
  if (words.command == "M163") {
    const double feeder = words.at('S'), share = words.at('P');
    require(feeder == std::floor(feeder) && feeder >= 0 && feeder < double(printer_.feeders),
            "there is no such feeder");
    require(share >= 0, "a share is negative");
    state_.shares[static_cast<std::size_t>(feeder)] = share;
    return;
  }
  const double tool = words.at('S');
  require(tool == std::floor(tool) && tool >= 0 && tool < double(dialect_.limits().virtual_tools),
          "there is no such tool");
  double sum = 0;
  for (std::size_t f = 0; f < printer_.feeders; ++f) {
    require(state_.shares[f].has_value(), "a tool is stored before all feeders have their shares");
    sum += *state_.shares[f];
  }
  require(sum > 0, "an all-zero mixture would hang the firmware");
  state_.shares = {};
  state_.defined.insert(static_cast<std::size_t>(tool));
}

/// M567 P0 E.5:.25:.25: the firmware multiplies E by each share.
void LineCheck::mix(std::string_view line) {
  constexpr std::string_view begin = "M567 P0 E";
  require(share_writing(dialect_) != nullptr, "this firmware does not know the command");
  require(line.starts_with(begin), "it is not the tool that mixes");
  require(state_.extruder_chosen, "the tool that mixes is not chosen");
  line.remove_prefix(begin.size());
  double sum = 0;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    double share = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), share);
    require(error == std::errc() && share >= 0, "a share is not a number, or negative");
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    sum += share;
    more = line.starts_with(':');
    if (more) line.remove_prefix(1);
  }
  require(line.empty() && count == printer_.feeders, "it does not have one share for each feeder");
  require(std::abs(sum - 1) < share_tolerance,
          "its shares do not add up to one, so that too much or too little is fed");
  state_.tool = 0;
}

void LineCheck::set_tool(const Words& words, const MoveListener& listener) {
  std::size_t tool = 0;
  const char* const end = words.command.data() + words.command.size();
  const auto result = std::from_chars(words.command.data() + 1, end, tool);
  require(result.ec == std::errc() && result.ptr == end, "the tool has no number");
  if (share_writing(dialect_)) {
    require(tool == 0, "it is not the tool that mixes");
    state_.extruder_chosen = true;
    return listener.stop();
  }
  require(state_.defined.contains(tool), "the tool was never defined");
  state_.tool = tool;
  if (dialect_.limits().tool_change_stops) listener.stop();
}

void LineCheck::move(const Words& words, const MoveListener& listener) {
  require(words.only("XYZEF"), "a move has a letter that moves do not have");
  PerAxis displacement{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto to = words.find(axes[axis]);
    if (!to) continue;
    require(*to >= -place_tolerance && *to <= printer_.bed[axis] + place_tolerance,
            "it leads out of the printer's bed");
    // After homing, the position is near the origin, which is precise enough for a time estimate.
    displacement[axis] = *to - state_.at[axis].value_or(0);
    state_.at[axis] = *to;
  }
  if (const auto feed = words.find('F')) state_.feed = *feed / 60;
  require(state_.feed > 0, "no speed is known");
  const double way = std::hypot(displacement[0], displacement[1], displacement[2]);
  displacement[3] = words.find('E').value_or(0);
  if (displacement[3] != 0)
    feed_filament(displacement[3], way);
  else
    check_flow();
  check_speed(displacement, way);
  if (way > 0 || displacement[3] != 0) listener.move(displacement, state_.feed);
}

void LineCheck::check_speed(const PerAxis& displacement, double length) const {
  const auto most = [](double limit) { return limit * (1 + speed_tolerance) + feed_rounding; };
  if (length == 0) return require(state_.feed <= most(printer_.retraction_speed), "filament runs too fast");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double speed = state_.feed * std::abs(displacement[axis]) / length;
    require(speed <= most(printer_.max_speed[axis]), "it is faster than an axis may run");
  }
}

void LineCheck::feed_filament(double filament, double length) {
  require(state_.relative_filament, "E is not relative");
  require(state_.tool.has_value(), "no tool is chosen");
  require(state_.nozzle > 0, "the nozzle is cold");
  require(std::abs(filament) <= dialect_.limits().extrusion, "it feeds more than the firmware takes at once");
  if (length == 0) {
    check_flow();
    state_.drawn -= filament;
    const auto [least, greatest] = std::minmax({1.0, greatest_factor_, least_factor_});
    const double slack = printer_.retraction_length * (greatest - least) + rounding;
    require(state_.drawn >= -slack && state_.drawn <= printer_.retraction_length + slack,
            "filament is drawn back too far, or pushed further than it was");
    return;
  }
  require(filament > 0, "filament is drawn back on the way");
  require(std::all_of(state_.at.begin(), state_.at.end(), [](const auto& at) { return at.has_value(); }),
          "a bead begins at an unknown place");
  state_.flow_way += length;
  state_.flow_seconds += length / state_.feed;
  state_.flow_filament += filament;
  if (state_.flow_way >= flow_span) check_flow();
}

/// Checks the mean flow since the last check; shorter pieces are too imprecise.
void LineCheck::check_flow() {
  const double volume = (state_.flow_filament / greatest_factor_ - rounding) * filament_area_;
  const double most = printer_.max_flow * (1 + flow_tolerance_here) * state_.flow_seconds;
  const bool long_enough = state_.flow_way >= flow_span;
  state_.flow_way = state_.flow_seconds = state_.flow_filament = 0;
  require(!long_enough || volume <= most, "more flows than the extruder melts");
}

}  // namespace unicursal::gcode
