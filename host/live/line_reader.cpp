#include "host/live/line_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace unicursal::host {
namespace {

constexpr std::size_t reader_tools = 64;  ///< virtual tools that are kept; firmwares have 16

}  // namespace

/// The words behind a command. Letters that are not there have no number.
class LineReader::Words {
 public:
  explicit Words(std::string_view text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
      if (*at == ' ') {
        ++at;
        continue;
      }
      const char letter = *at++;
      double number = 0;
      const auto [stop, error] = std::from_chars(at, end, number, std::chars_format::fixed);
      if (letter < 'A' || letter > 'Z') {
        while (at != end && *at != ' ') ++at;
        continue;
      }
      there_ |= bit(letter);
      if (error == std::errc() && std::isfinite(number)) {
        numbers_[index(letter)] = number;
        valued_ |= bit(letter);
        at = stop;
      }
      while (at != end && *at != ' ') ++at;
    }
  }

  bool has(char letter) const { return (there_ & bit(letter)) != 0; }
  bool valued(char letter) const { return (valued_ & bit(letter)) != 0; }
  double number(char letter) const { return numbers_[index(letter)]; }
  double number_or(char letter, double otherwise) const {
    return valued(letter) ? number(letter) : otherwise;
  }

 private:
  static std::size_t index(char letter) { return static_cast<std::size_t>(letter - 'A'); }
  static unsigned bit(char letter) { return 1U << (letter - 'A'); }

  std::array<double, 26> numbers_;  ///< those that are valued
  unsigned there_ = 0, valued_ = 0;
};

LineReader::LineReader(const gcode::Printer& printer)
    : factors_(printer.flow_factors),
      filament_area_(std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter),
      collected_(gcode::Shares::zeros(printer.feeders)),
      fed_(gcode::Mixture::equal(printer.feeders).shares()) {}

std::optional<core::Vec2> LineReader::place() const {
  if (!position_[0] || !position_[1]) return std::nullopt;
  return core::Vec2(*position_[0], *position_[1]);
}

LineMotion LineReader::read(std::string_view line) {
  if (line.size() < 2) return {};
  int code = -1;
  const auto [end, error] = std::from_chars(line.data() + 1, line.data() + line.size(), code);
  if (error != std::errc()) return {};
  const std::string_view rest = line.substr(static_cast<std::size_t>(end - line.data()));
  if (line.front() == 'G') {
    if (code >= 0 && code <= 3) return move(Words(rest));
    if (code == 28) home(Words(rest));
    if (code == 90 || code == 91) relative_ = relative_filament_ = code == 91;
    if (code == 92) call_it(Words(rest));
  } else if (line.front() == 'T') {
    if (code >= 0 && static_cast<std::size_t>(code) < tools_.size())
      choose(tools_[static_cast<std::size_t>(code)]);
  } else if (line.front() == 'M') {
    if (code == 163 || code == 164)
      define(rest, code);
    else if (code == 567)
      mix(rest);
    else if (code == 82 || code == 83)
      relative_filament_ = code == 83;
    else if (code == 221)
      flow_percent_ = std::clamp(Words(rest).number_or('S', flow_percent_), 1.0, 1000.0);
  }
  return {};
}

/// Arcs count as chords: none of this program's dialects writes them.
LineMotion LineReader::move(const Words& words) {
  LineMotion motion;
  if (words.valued('F') && words.number('F') > 0) feed_ = words.number('F') / 60;
  const auto from = place();
  double squares = 0;
  for (std::size_t axis = 0; axis < position_.size(); ++axis) {
    const char letter = "XYZ"[axis];
    if (!words.valued(letter)) continue;
    const double to = relative_ ? position_[axis].value_or(0) + words.number(letter) : words.number(letter);
    if (!position_[axis] || to != *position_[axis]) motion.moves = true;
    const double way = to - position_[axis].value_or(to);
    squares += way * way;
    position_[axis] = to;
  }
  double e = 0;
  if (words.valued('E')) {
    e = relative_filament_ ? words.number('E') : words.number('E') - filament_;
    filament_ += e;
  }
  if (e != 0) motion.moves = true;
  motion.volume = e * flow_percent_ / 100 * turned_ * filament_area_;
  if (from && place()) {
    motion.from = *from;
    motion.to = *place();
    motion.travels = motion.from != motion.to;
  }
  if (feed_ > 0) motion.seconds = (squares > 0 ? std::sqrt(squares) : std::abs(e)) / feed_;
  return motion;
}

/// Positions are unknown after homing, since the places of the end switches are.
void LineReader::home(const Words& words) {
  const bool some = words.has('X') || words.has('Y') || words.has('Z');
  for (std::size_t axis = 0; axis < position_.size(); ++axis)
    if (!some || words.has("XYZ"[axis])) position_[axis].reset();
}

void LineReader::call_it(const Words& words) {
  for (std::size_t axis = 0; axis < position_.size(); ++axis)
    if (words.valued("XYZ"[axis])) position_[axis] = words.number("XYZ"[axis]);
  filament_ = words.number_or('E', filament_);
}

/// " S1 P0.25" of M163, or " S3" of M164.
void LineReader::define(std::string_view text, int code) {
  const Words words(text);
  const double which = words.number_or('S', -1);
  if (which < 0 || which >= static_cast<double>(reader_tools)) return;
  const auto index = static_cast<std::size_t>(which);
  if (code == 163) {
    if (index < collected_.size()) collected_[index] = std::max(words.number_or('P', 0), 0.0);
    return;
  }
  while (tools_.size() <= index) tools_.push_back(gcode::Mixture::equal(collected_.size()).shares());
  tools_[index] = collected_;
}

/// " P0 E0.5:0.25:0.25" of M567: from here on moves feed these shares.
void LineReader::mix(std::string_view text) {
  const std::size_t begin = text.find('E');
  if (begin == std::string_view::npos) return;
  gcode::Shares written = gcode::Shares::zeros(collected_.size());
  const char* at = text.data() + begin + 1;
  const char* const end = text.data() + text.size();
  for (double& share : written) {
    const auto [stop, error] = std::from_chars(at, end, share);
    if (error != std::errc() || share < 0) return;
    at = stop != end && *stop == ':' ? stop + 1 : stop;
  }
  choose(written);
}

/// `written`: as the lines say it, in any unit.
void LineReader::choose(const gcode::Shares& written) {
  double sum = 0, fed = 0;
  for (const double share : written) sum += share;
  if (sum <= 0) return;
  gcode::Shares shares = written;
  for (std::size_t f = 0; f < shares.size(); ++f) fed += shares[f] = written[f] / sum / factors_[f];
  for (double& share : shares) share /= fed;
  fed_ = shares;
  turned_ = fed;
}

}  // namespace unicursal::host
