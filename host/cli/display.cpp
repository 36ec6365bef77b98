#include "host/cli/display.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>

#include "firmware_gcode/reply/reply.hpp"
#include "host/cli/for_terminal.hpp"
#include "host/engine/session_json.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_interval = 100ms;
constexpr auto event_interval = 1000ms;  ///< between events of progress or heat
constexpr std::size_t usual_width = 100;

std::size_t terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : usual_width;
}

/// Returns whether a person should see this event: errors, and what the printer does on its own.
bool is_news(const SessionEvent& event) {
  if (event.kind == SessionEvent::Kind::notice) return true;
  if (event.kind != SessionEvent::Kind::printer) return false;
  for (const char* start : {"Error", "//action", "echo: cold", "echo: too long", "!!"}) {
    if (event.text.starts_with(start)) return true;
  }
  return false;
}

std::string heat(const char* what, const std::optional<double>& actual, const std::optional<double>& target) {
  if (!actual) return {};
  if (!target || *target <= 0) return fmt::format(", {} {:.0f} °C", what, *actual);
  return fmt::format(", {} {:.0f}/{:.0f} °C", what, *actual, *target);
}

/// Cuts the text to `width` characters, not bytes: a degree sign is two bytes.
std::string cut(std::string text, std::size_t width) {
  std::size_t letters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U) continue;
    if (++letters > width) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::string status_line(const SessionStatus& s, std::size_t width) {
  std::string line = name(s.state);
  const auto out = std::back_inserter(line);
  if (s.layer > 0) fmt::format_to(out, " layer {} of {}, {:.0f} %", s.layer, s.layers, s.percent);
  if (s.left && !has_ended(s.state)) fmt::format_to(out, ", {} left", duration_words(*s.left));
  const gcode::Temperatures& t = s.temperatures;
  line += heat("nozzle", t.nozzle, t.nozzle_target) + heat("bed", t.bed, t.bed_target);
  if (!s.mixture.empty()) line += ", " + s.mixture;
  if (s.lookahead_layers > 0) fmt::format_to(out, ", {} planned ahead", duration_words(s.lookahead));
  if (s.queue) fmt::format_to(out, ", queue {:.0f} %", 100 * *s.queue);
  if (s.speed_percent != 100) fmt::format_to(out, ", speed {:.0f} %", s.speed_percent);
  if (s.flow_percent != 100) fmt::format_to(out, ", flow {:.0f} %", s.flow_percent);
  return cut(line, width);
}

Display::Display(DisplayForm form)
    : form_(form),
      terminal_(isatty(STDERR_FILENO) == 1),
      messages_(STDERR_FILENO,
                [](std::size_t count) {
                  return fmt::format("({} lines are missing here, since they were not read in time)\n",
                                     count);
                }),
      events_(STDOUT_FILENO, [](std::size_t count) {
        return nlohmann::json{{"event", "gap"}, {"lost", count}}.dump() + "\n";
      }) {
  std::fflush(stdout);  // what was shown before comes first
}

Display::~Display() {
  clear();
}

void Display::show(const Session& session, const SessionEvent& event) {
  if (form_ == DisplayForm::json) {
    const bool often = event.kind == SessionEvent::Kind::progress || event.kind == SessionEvent::Kind::heat;
    if (!often || is_due(event_interval)) write(event, session.status());
    return;
  }
  if (is_news(event)) return say(event.text);
  const bool changed = event.kind == SessionEvent::Kind::state;
  if (changed || !terminal_ || is_due(redraw_interval)) {
    const SessionStatus status = session.status();
    if (changed && !status.reason.empty() && !has_ended(status.state))
      say(fmt::format("{}: {}", name(status.state), status.reason));
    draw(status);
  }
}

bool Display::is_due(std::chrono::milliseconds interval) {
  const auto now = Clock::now();
  if (now - last_ < interval) return false;
  last_ = now;
  return true;
}

/// Without a terminal, shows a line only when another tenth of the print is done.
void Display::draw(const SessionStatus& status) {
  if (terminal_) {
    messages_.refresh("\r\x1b[K" + for_terminal(status_line(status, terminal_width() - 1)));
    drawn_ = true;
    return;
  }
  const int tenth = static_cast<int>(status.percent / 10);
  if (status.layer == 0 || tenth <= last_tenth_) return;
  last_tenth_ = tenth;
  messages_.write(for_terminal(status_line(status, SIZE_MAX)) + "\n");
}

void Display::say(const std::string& sentence) {
  clear();
  messages_.write(for_terminal(sentence) + "\n");
}

void Display::notice(const std::string& sentence) {
  if (form_ != DisplayForm::json) return say(sentence);
  const nlohmann::json event = {{"event", "notice"}, {"text", sentence}};
  events_.write(json_for_terminal(event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) +
                "\n");
}

void Display::answer(const std::string& sentence) {
  say(sentence);
}

void Display::clear() {
  if (drawn_) messages_.write("\r\x1b[K");
  drawn_ = false;
}

void Display::write(const SessionEvent& event, const SessionStatus& status) {
  const auto event_json = to_json(event, status);
  events_.write(json_for_terminal(event_json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) +
                "\n");
}

}  // namespace unicursal::host
