#include "host/cli/display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/cli/columns.hpp"
#include "host/cli/for_terminal.hpp"
#include "host/cli/wrapped.hpp"
#include "host/engine/session_json.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_interval = 100ms;
constexpr auto event_interval = 1000ms;  ///< between events of progress or heat

/// Returns whether a person should see this event: errors, and what the printer does on its own.
bool is_news(const SessionEvent& event) {
  if (event.kind == SessionEvent::Kind::notice) return true;
  if (event.kind != SessionEvent::Kind::printer) return false;
  for (const char* start : {"Error", "//action", "echo: cold", "echo: too long", "!!"}) {
    if (event.text.starts_with(start)) return true;
  }
  return false;
}

/// Whether a person must see this event, whatever else they do not want to see.
bool is_urgent(const SessionEvent& event) {
  if (event.kind != SessionEvent::Kind::notice && event.kind != SessionEvent::Kind::printer) return false;
  for (const char* start : {"Warning", "Error", "echo: cold", "echo: too long", "!!"}) {
    if (event.text.starts_with(start)) return true;
  }
  return false;
}

/// Goes from the typed line to the beginning of the progress line, and erases both.
constexpr auto erase_both = "\r\x1b[1A\x1b[J";
constexpr auto erase_one = "\r\x1b[K";
constexpr auto prompt = "> ";
constexpr std::size_t prompt_width = 2;

bool shows_progress_line(DisplayForm form, const TerminalLook& terminal) {
  return form == DisplayForm::words && terminal.rewrites;
}

}  // namespace

Display::Display(DisplayForm form, StatusLook look)
    : form_(form),
      terminal_(look_of(STDERR_FILENO)),
      look_(std::move(look)),
      messages_(STDERR_FILENO,
                [](std::size_t count) {
                  return fmt::format("({} lines are missing here, since they were not read in time)\n",
                                     count);
                }),
      events_(STDOUT_FILENO, [](std::size_t count) {
        return nlohmann::json{{"event", "gap"}, {"lost", count}}.dump() + "\n";
      }) {
  std::fflush(stdout);  // what was shown before comes first
  look_.colours = terminal_.colours;
  if (shows_progress_line(form_, terminal_)) keyboard_.emplace();
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
  const bool changed = event.kind == SessionEvent::Kind::state;
  if (form_ == DisplayForm::urgent_words) {
    if (is_urgent(event)) return say(event.text);
    if (changed && session.status().state == SessionState::paused) say_why(session.status());
    return;
  }
  if (is_news(event)) return say(event.text);
  if (changed || !terminal_.rewrites || is_due(redraw_interval)) {
    const SessionStatus status = session.status();
    if (changed && !has_ended(status.state)) say_why(status);
    draw(status);
  }
}

void Display::say_why(const SessionStatus& status) {
  if (!status.reason.empty()) say(fmt::format("{}: {}", name(status.state), status.reason));
}

bool Display::is_due(std::chrono::milliseconds interval) {
  const auto now = Clock::now();
  if (now - last_ < interval) return false;
  last_ = now;
  return true;
}

/// Without a terminal, shows a line only when another tenth of the print is done.
void Display::draw(const SessionStatus& status) {
  if (look_.dry) time_dry_run(status.percent);
  if (terminal_.rewrites) {
    last_status_ = status;
    return draw_again();
  }
  const int tenth = static_cast<int>(status.percent / 10);
  if (status.layer == 0 || tenth <= last_tenth_) return;
  last_tenth_ = tenth;
  messages_.write(status_line(status, look_, SIZE_MAX, std::chrono::system_clock::now()) + "\n");
}

/// A text that is written only if no newer one waits must suit what any other one like it has left.
void Display::draw_again() {
  const std::size_t width = terminal_width(STDERR_FILENO) - 1;
  const std::string line = status_line(last_status_, look_, width, std::chrono::system_clock::now());
  const bool two = keyboard_ && keyboard_->held();
  if (two && !drawn_) messages_.write("\n");
  drawn_ = true;
  if (!two) return messages_.refresh(erase_one + line);
  const std::size_t room = width - std::min(width, prompt_width);
  messages_.refresh(erase_both + line + "\n" + prompt + ending(for_terminal(typing_), room));
}

/// By the pace so far: planning takes most of the time of a dry run, and is unlike the printing.
void Display::time_dry_run(double percent) {
  constexpr double enough_percent = 2, enough_seconds = 1;
  if (percent <= 0) return;
  if (!dry_run_began_) dry_run_began_ = Clock::now();
  const double passed = std::chrono::duration<double>(Clock::now() - *dry_run_began_).count();
  if (percent >= enough_percent && passed >= enough_seconds)
    look_.dry_left = passed * (100 - percent) / percent;
}

void Display::say(const std::string& sentence) {
  const bool shown = drawn_;
  clear();
  std::string text = for_terminal(sentence);
  if (isatty(STDERR_FILENO) == 1) text = wrapped(text, terminal_width(STDERR_FILENO));
  messages_.write(text + "\n");
  if (shown && keyboard_ && keyboard_->held()) draw_again();
}

void Display::typing(const std::string& text) {
  if (!keyboard_ || !keyboard_->held()) return;
  typing_ = text;
  draw_again();
}

void Display::typed(const std::string& words) {
  if (keyboard_ && keyboard_->held()) say(prompt + words);
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
  if (drawn_) messages_.write(keyboard_ && keyboard_->held() ? erase_both : erase_one);
  drawn_ = false;
}

void Display::write(const SessionEvent& event, const SessionStatus& status) {
  const auto event_json = to_json(event, status);
  events_.write(json_for_terminal(event_json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) +
                "\n");
}

}  // namespace unicursal::host
