#include "host/engine/printer_display.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>
#include <variant>

#include "firmware_gcode/reply/reply.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;
using WallTime = PrinterDisplay::WallTime;

constexpr auto least_interval = 10s, usual_interval = 60s;
constexpr std::size_t display_width = 20;  ///< characters of a common display
constexpr double clock_until = 18 * 3600;  ///< s left, from which on the day is needed as well

std::string clock_text(WallTime at, bool with_day) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(at);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  return with_day ? fmt::format("{:%a %H:%M}", parts) : fmt::format("{:%H:%M}", parts);
}

std::string progress_text(const PrinterDisplay::Progress& progress, WallTime now) {
  std::string ready;
  if (progress.left) {
    const auto at = now + std::chrono::seconds(std::lround(std::max(*progress.left, 0.0)));
    ready = " " + clock_text(at, *progress.left >= clock_until);
  }
  const std::array forms{fmt::format("Layer {}/{}{}", progress.layer, progress.layers, ready),
                         fmt::format("{}/{}{}", progress.layer, progress.layers, ready),
                         fmt::format("{}/{}", progress.layer, progress.layers)};
  const auto fits = [](const std::string& form) { return form.size() <= display_width; };
  return *std::find_if(forms.begin(), std::prev(forms.end()), fits);
}

}  // namespace

void PrinterDisplay::begin(const gcode::Identity& printer, const std::string& firmware) {
  using gcode::Family;
  const bool marlin =
      printer.family == Family::marlin || (printer.family == Family::unknown && firmware == "marlin");
  shows_text_ = true;
  takes_numbers_ = marlin && (printer.can("BUILD_PERCENT") || printer.capabilities.empty());
}

bool PrinterDisplay::rests(TimePoint now) const {
  return (!shows_text_ && !takes_numbers_) || (shown_at_ && now - *shown_at_ < least_interval);
}

std::vector<std::string> PrinterDisplay::due(const Progress& progress, const Moment& moment) {
  if (rests(moment.now) || progress.layer == 0) return {};
  const long percent = std::clamp(std::lround(std::floor(progress.percent)), 0L, 100L);
  const bool same = shown_at_ && progress.layer == layer_ && percent == percent_;
  if (same && moment.now - *shown_at_ < usual_interval) return {};
  shown_at_ = moment.now;
  layer_ = progress.layer;
  percent_ = percent;
  std::string numbers = fmt::format("M73 P{}", percent);
  if (progress.left) numbers += fmt::format(" R{:.0f}", std::ceil(std::max(*progress.left, 0.0) / 60));
  return lines_for(numbers, progress_text(progress, moment.time_of_day));
}

std::vector<std::string> PrinterDisplay::word(const std::string& text) {
  shown_at_.reset();
  return lines_for(numbers_, text);
}

std::vector<std::string> PrinterDisplay::done(const Moment& moment) {
  return lines_for("M73 P100 R0", "Done " + clock_text(moment.time_of_day, false));
}

/// What is shown already is left out.
std::vector<std::string> PrinterDisplay::lines_for(const std::string& numbers, const std::string& text) {
  std::vector<std::string> lines;
  if (takes_numbers_ && numbers != numbers_) lines.push_back(numbers);
  if (shows_text_ && text != text_) lines.push_back("M117 " + text);
  numbers_ = numbers;
  text_ = text;
  return lines;
}

/// A Marlin that prompts through the host sends back what it shows.
bool PrinterDisplay::hear(const std::string& line) {
  if (!shows_text_ && !takes_numbers_) return false;
  const gcode::Reply reply = gcode::parse_reply(line);
  if (const auto* action = std::get_if<gcode::reply::Action>(&reply))
    return !text_.empty() && action->text == "notification " + text_;
  const auto* echo = std::get_if<gcode::reply::Echo>(&reply);
  if (!echo || !echo->unknown_command) return false;
  const auto denies = [&](const char* command, bool& flag) {
    return echo->text.find(command) != std::string::npos && std::exchange(flag, false);
  };
  return denies("M73", takes_numbers_) || denies("M117", shows_text_);
}

}  // namespace unicursal::host
