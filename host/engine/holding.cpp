#include "host/engine/holding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "firmware_gcode/toolpath/job_frame.hpp"
#include "host/engine/seconds.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

/// Between signs of life to a printer that is held: more often than any firmware switches its motors off
/// (Marlin: two minutes), which would lose the place, and soon enough to find that the cable is out.
constexpr auto sign_of_life = 10s;
/// How long the nozzle may stand on the part with nothing to do: it melts into it, and what drips stays
/// there.
constexpr auto idle_patience = 5s;
/// How long a nozzle is kept hot during a pause: the plastic in it chars, and a hot nozzle is a danger.
constexpr auto hot_patience = 15min;
/// How long a firmware that has paused itself may be silent about it; Marlin repeats every 2 s that it waits.
constexpr auto firmware_patience = 6s;
constexpr auto look_interval = 2s;  ///< between looks whether what is missing has come

std::vector<std::string> signs_of_life() {
  return {gcode::stay_watchful()};
}

}  // namespace

asio::awaitable<void> Holding::between_batches() {
  co_await make_changes(false);
  while (parts_.intent.pausing()) {
    co_await hold();
    co_await guard_again();
    co_await make_changes(false);
  }
}

/// Both moves of a retraction must have the same flow factor, or the filament is not where it was.
/// `drawn`: the filament is drawn back by lines that are not the print's.
bool Holding::can_change(const std::string& line, bool drawn) const {
  return !line.starts_with("M221") || (!drawn && parts_.printer.expected.drawn_back == 0);
}

bool Holding::change_due(bool drawn) const {
  return std::any_of(changes_.begin(), changes_.end(),
                     [&](const std::string& line) { return can_change(line, drawn); });
}

asio::awaitable<void> Holding::make_changes(bool drawn) {
  while (!parts_.intent.ends()) {
    const auto due = std::find_if(changes_.begin(), changes_.end(),
                                  [&](const std::string& line) { return can_change(line, drawn); });
    if (due == changes_.end()) co_return;
    std::vector<std::string> lines(1, *due);
    changes_.erase(due);
    parts_.printer.expected.run(lines.front());
    co_await parts_.places.interpose(std::move(lines));
  }
}

gcode::Pause Holding::pause_here() const {
  return {parts_.printer.expected, parts_.source.extent(), parts_.source.flow(),
          parts_.settings.pause_heat == PauseHeat::lower};
}

void Holding::report_position() {
  report_printed(parts_.source, *parts_.settings.clock,
                 parts_.progress.chunk_seconds_left() * 100 / parts_.printer.speed_percent);
}

/// Before the first move there is nothing to go away from.
asio::awaitable<void> Holding::hold() {
  const bool moving = !parts_.intent.paused_by_firmware() && parts_.printer.knows_position();
  waits_until_ = now() + firmware_patience;
  co_await go_aside(parts_.intent.reason(), moving);
  const bool moved = co_await wait_held(moving);
  parts_.intent.end_pause();
  waited_ = false;
  co_await come_back(moved);
}

/// Precondition: the printer is not in a wait for heat.
asio::awaitable<void> Holding::go_aside(std::string why, bool moving) {
  ++pauses_;
  parts_.announcer.enter(SessionState::pausing, why);
  if (moving) {
    gcode::Chunk chunk = gcode::go_aside(parts_.source.printer(), pause_here());
    parts_.places.record_progress();
    way_aside_ = chunk.lines;
    parts_.places.record_way(way_aside_);
    co_await parts_.places.interpose(std::move(chunk.lines));
    co_await parts_.link.drain();
    parts_.places.record_progress();
    parts_.places.record_aside();
    co_await parts_.places.interpose(parts_.printer.display.word("Paused"));
  }
  hot_until_ = std::exchange(cool_soon_, false) ? now() : now() + hot_patience;
  parts_.announcer.enter(SessionState::paused, why);
}

asio::awaitable<void> Holding::come_back(bool moving) {
  const Intent& intent = parts_.intent;
  if (intent.ends()) co_return;
  parts_.announcer.enter(SessionState::resuming);
  report_position();
  parts_.printer.may_wait_for_heat = true;  // a stop ends it
  if (moving) {
    std::vector<std::string> lines = gcode::come_back(parts_.source.printer(), pause_here()).lines;
    way_aside_.insert(way_aside_.end(), lines.begin(), lines.end());
    parts_.places.record_way(way_aside_);  // first: from now on the nozzle may be anywhere on it
    co_await parts_.places.interpose(std::move(lines));
  }
  if (moving && !intent.ends()) co_await parts_.link.drain();
  parts_.printer.may_wait_for_heat = false;
  if (moving) cooled_ = false;
  co_await heat_again();
  if (intent.ends()) co_return;
  if (moving) parts_.places.record_way({});
  parts_.announcer.enter(SessionState::printing);
}

/// For a nozzle that has cooled without having been moved.
asio::awaitable<void> Holding::heat_again() {
  if (!std::exchange(cooled_, false) || parts_.intent.ends()) co_return;
  parts_.printer.may_wait_for_heat = true;  // a stop ends it
  std::vector<std::string> lines(1, fmt::format("M109 S{:.0f}", parts_.printer.expected.nozzle));
  co_await parts_.places.interpose(std::move(lines));
  if (!parts_.intent.ends()) co_await parts_.link.drain();
  parts_.printer.may_wait_for_heat = false;
}

/// Returns when the pause ends, whether the nozzle stands aside then. Changes that are requested meanwhile
/// are made at once.
asio::awaitable<bool> Holding::wait_held(bool aside) {
  const Intent& intent = parts_.intent;
  const auto& longest = parts_.settings.longest_pause;
  const TimePoint last = longest ? now() + duration(*longest) : TimePoint::max();
  const std::function<bool()> ready = [&] { return !intent.paused() || change_due(aside); };
  while (intent.paused()) {
    const Duration look = intent.paused_by_firmware() ? Duration(look_interval) : Duration(sign_of_life);
    if (!co_await parts_.wake.wait(std::min(last, now() + look), ready)) {
      if (now() >= last) break;
      if (intent.paused_by_firmware())
        aside = co_await look_after_firmware();
      else
        co_await stay_aside(parts_.printer.knows_position());
    }
    co_await make_changes(aside);
  }
  co_return aside;
}

/// A firmware that waits for a person reads nothing and says so. One that takes lines again has ended its
/// wait, although its word for that is lost. One that has never waited stands on the part: some mixing builds
/// of Marlin announce a change of filament and then refuse it ("M600 E stepper not specified"). Returns
/// whether the nozzle has been taken aside.
asio::awaitable<bool> Holding::look_after_firmware() {
  if (parts_.link.waits_for_user()) waits_until_ = now() + firmware_patience;
  const LinkStatistics& taken = parts_.link.statistics();
  if (now() < waits_until_ || taken.acknowledged < taken.lines) co_return false;
  co_await parts_.places.interpose(signs_of_life());
  co_await parts_.link.drain();
  if (!parts_.intent.paused()) co_return false;
  if (waited_) {
    parts_.announcer.notice("the printer has gone on by itself");
    parts_.intent.end_pause();
    co_return false;
  }
  parts_.intent.take_over();
  const bool moving = parts_.printer.knows_position();
  co_await go_aside(parts_.intent.reason() + "; since it did not wait, its nozzle was taken aside", moving);
  --pauses_;  // it is the same one
  co_return moving;
}

/// Lets the firmware know that this program is alive. If nobody comes for long, the nozzle cools until the
/// print goes on.
asio::awaitable<void> Holding::stay_aside(bool moved) {
  report_position();
  co_await parts_.places.interpose(signs_of_life());
  const bool lower = parts_.settings.pause_heat == PauseHeat::lower;
  if (cooled_ || (lower && moved)) co_return;  // on the way aside
  if (!(lower && parts_.intent.paused_by_session()) && now() < hot_until_) co_return;
  cooled_ = true;
  parts_.announcer.notice("the nozzle cools; it is heated again before the print continues");
  std::vector<std::string> cool(1, gcode::cool_aside(parts_.printer.expected));
  co_await parts_.places.interpose(std::move(cool));
}

asio::awaitable<void> Holding::wait_for(const Need& need) {
  const Intent& intent = parts_.intent;
  // Before the printer has answered there is nothing to be steered.
  const bool connected = parts_.announcer.state() != SessionState::connecting;
  const std::function<bool()> event = [&] {
    return need.come() || intent.ends() || (connected && (intent.pausing() || change_due(false)));
  };
  while (!need.come() && !intent.ends()) {
    const TimePoint patient_until = now() + idle_patience;
    while (!event() && now() < patient_until) {
      if (need.look) co_await need.look();
      std::optional<Clock::Hold> hold;
      if (need.at_work) hold.emplace(*parts_.settings.clock);
      co_await parts_.wake.wait(std::min(std::min(patient_until, need.at), now() + look_interval), event);
    }
    if (event())
      co_await between_batches();
    else
      co_await wait_aside(need);
  }
}

/// A pause that was asked for meanwhile lasts until the user ends it. As long as nothing is laid, the nozzle
/// may stay where it is.
asio::awaitable<void> Holding::wait_aside(const Need& need) {
  const Intent& intent = parts_.intent;
  const bool moving = parts_.progress.has_laid() && parts_.printer.knows_position();
  const std::function<bool()> over = [&] {
    if (intent.ends()) return true;
    const bool paused = intent.paused_by_session();
    return moving ? need.come() && !paused : need.come() || paused;
  };
  const std::function<bool()> event = [&] { return over() || change_due(moving); };
  waits_aside_ = moving;
  hot_until_ = now() + hot_patience;
  if (moving) co_await go_aside(need.why, true);
  for (TimePoint sign = now() + sign_of_life; !over();) {
    TimePoint next = sign;
    if (!need.come()) {
      if (need.look) co_await need.look();
      next = std::min(need.at, need.look ? now() + look_interval : sign);
    }
    co_await parts_.wake.wait(next, event);
    if (parts_.announcer.state() == SessionState::connecting) continue;
    co_await make_changes(moving);
    if (now() < sign) continue;
    sign = now() + sign_of_life;
    co_await stay_aside(moving);
  }
  waits_aside_ = false;
  if (moving)
    co_await come_back(true);
  else
    co_await heat_again();
}

// ---- commands

/// Whether it is too late for a command.
bool Holding::over() const {
  return has_ended(parts_.announcer.state()) || parts_.announcer.is_ending() || parts_.intent.ends();
}

Refusal Holding::pause(const std::string& reason) {
  if (over()) return ends_already;
  if (parts_.intent.pausing()) return "it is paused already";
  parts_.intent.pause(reason);
  parts_.announcer.notice(parts_.printer.may_wait_for_heat ? pause_when_hot : "the print pauses in a moment");
  return std::nullopt;
}

Refusal Holding::resume() {
  if (parts_.intent.ends()) return ends_already;
  if (waits_aside_ && !parts_.intent.pausing()) return "the print is waiting: " + parts_.announcer.reason();
  if (!parts_.intent.pausing() && !parts_.announcer.holds()) return "it is not paused";
  if (parts_.intent.paused_by_firmware() && parts_.link.waits_for_user()) {
    // It ends when the printer goes on; it may ask something else first.
    let_printer_go_on();
    parts_.announcer.notice("the printer was asked to go on");
    return std::nullopt;
  }
  end_pause();
  return std::nullopt;
}

Refusal Holding::answer(std::size_t button) {
  HostPrompt& prompt = parts_.printer.prompt;
  if (!prompt.shown()) return "the printer does not ask anything";
  if (button >= prompt.buttons().size())
    return fmt::format("{} is not one of its answers: {}", button, prompt.sentence());
  parts_.announcer.notice(fmt::format("the printer was answered: {}", prompt.buttons()[button]));
  prompt.answered();
  parts_.link.answer_prompt(button);
  return std::nullopt;
}

/// In a batch of its own, since the printer may be about to ask again.
asio::awaitable<void> Holding::guard_again() {
  if (!std::exchange(unguarded_, false)) co_return;
  std::vector<std::string> lines(1, "M412 S1");
  co_await parts_.places.interpose(std::move(lines));
  parts_.announcer.notice("the printer's filament sensor is on again");
}

/// It answers the printer's question, if there is one.
void Holding::let_printer_go_on() {
  HostPrompt& prompt = parts_.printer.prompt;
  unguarded_ = unguarded_ || (prompt.shown() && prompt.going_on_is_unguarded());
  prompt.answered();
  parts_.link.end_wait_for_user();
}

/// A pause that has not been carried out is forgotten.
void Holding::end_pause() {
  if (parts_.link.waits_for_user()) let_printer_go_on();
  if (parts_.intent.paused_by_firmware() || (parts_.announcer.holds() && !waits_aside_))
    parts_.intent.resume();
  else
    parts_.intent.end_pause();
  parts_.wake.notify();
}

Refusal Holding::change(const std::string& line) {
  if (over()) return ends_already;
  changes_.push_back(line);
  parts_.wake.notify();
  return std::nullopt;
}

void Holding::pause_for_fault(const std::string& reason, bool cool) {
  if (over() || !parts_.intent.printing() || waits_aside_ || parts_.announcer.holds()) return;
  cool_soon_ = cool;
  parts_.intent.pause(reason);
  parts_.announcer.notice("Error: " + reason);
  parts_.wake.notify();
}

void Holding::pause_for_printer(const std::string& reason, PausedBy by) {
  if (!over()) parts_.intent.pause(reason, by);
  parts_.wake.notify();
}

/// Before the printer has answered, and at the end, no print can be held. A nozzle that is to be
/// parked does not wait for a person.
void Holding::printer_waits() {
  if (parts_.intent.ends()) return let_printer_go_on();
  const SessionState state = parts_.announcer.state();
  if (state == SessionState::connecting || over()) return;
  if (!std::exchange(waited_, true)) wait_began_ = now();
  const auto& longest = parts_.settings.longest_pause;
  if (longest && now() >= wait_began_ + duration(*longest)) return let_printer_go_on();
  HostPrompt& prompt = parts_.printer.prompt;
  const bool asked = prompt.shown() && prompt.is_new();
  parts_.intent.pause(prompt.shown() ? prompt.sentence() : "the printer waits for a person",
                      PausedBy::firmware);
  if (!parts_.intent.paused_by_firmware()) return;
  if (asked || state != SessionState::paused)
    parts_.announcer.enter(SessionState::paused, asked ? prompt.sentence() : parts_.intent.reason());
  parts_.wake.notify();
}

void Holding::look_for_person() {
  if (!parts_.printer.may_wait_for_heat || !waited_ || parts_.link.waits_for_user()) return;
  waited_ = false;
  if (!parts_.intent.paused_by_firmware()) return;
  parts_.intent.end_pause();
  parts_.announcer.enter(SessionState::heating);
}

void Holding::resume_for_printer() {
  if (parts_.intent.pausing()) end_pause();
}

}  // namespace unicursal::host
