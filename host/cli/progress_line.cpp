#include "host/cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "host/cli/terminal_output.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(100);

}  // namespace

ProgressLine::ProgressLine(std::string what, std::size_t layers)
    : what_(std::move(what)), layers_(layers), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  clear();
}

std::string ProgressLine::line(std::size_t begun, double share) const {
  const double passed = std::chrono::duration<double>(Clock::now() - started_).count();
  return fmt::format("{} layer {} of {}, {:.0f} %, {}", what_, std::min(begun + 1, layers_), layers_,
                     100 * share, duration_words(passed));
}

void ProgressLine::update(std::size_t begun, double fraction) {
  if (layers_ == 0) return;
  const double share = std::min(1.0, (static_cast<double>(begun) + fraction) / static_cast<double>(layers_));
  const int tenth = static_cast<int>(10 * share);
  if (!terminal_) {
    if (tenth > last_tenth_) show(stderr, "{}\n", line(begun, share));
    last_tenth_ = std::max(tenth, last_tenth_);
    return;
  }
  const auto now = Clock::now();
  if (now - drawn_ < redraw_interval) return;
  drawn_ = now;
  shown_ = true;
  erase_line(stderr);
  show(stderr, "{}", line(begun, share));
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (shown_) erase_line(stderr);
  shown_ = false;
  std::fflush(stderr);
}

}  // namespace unicursal::host
