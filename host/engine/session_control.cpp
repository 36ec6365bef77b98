// A session's commands: what they leave for the print to find, and what the print makes of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware_gcode/toolpath/job_frame.hpp"
#include "host/engine/reset_line.hpp"
#include "host/engine/session_impl.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

/// Between signs of life to a printer that is held: more often than any firmware lets its motors go (Marlin:
/// two minutes), which would lose the place, and soon enough to find that the cable is out.
constexpr auto sign_of_life = 10s;
/// That the nozzle may stand on the part with nothing to do: it melts into it, and what drips stays there.
constexpr auto idle_patience = 5s;
/// That a nozzle is kept hot though nobody has come: what is in it chars, and it is a danger.
constexpr auto hot_patience = 15min;
constexpr auto look_interval = 2s;  ///< between looks whether what is lacking has come
constexpr auto stop_patience = 2s;  ///< for the printer to confirm an emergency stop

constexpr double least_speed = 10, most_speed = 300;  ///< %
constexpr double least_flow = 50, most_flow = 200;    ///< %
constexpr double hottest_nozzle = 450,
                 hottest_bed = 200;  ///< °C, as for a profile; beyond, it is a typing error

constexpr auto over = "the print is ending";

std::vector<std::string> signs_of_life() {
  return {gcode::stay_watchful()};
}

/// None, if it is within.
Refusal outside(const char* what, double value, double least, double most, const char* unit) {
  if (std::isfinite(value) && value >= least && value <= most) return std::nullopt;
  return fmt::format("{} {:g} {} is not between {:g} and {:g}", what, value, unit, least, most);
}

}  // namespace

asio::awaitable<void> Session::State::between() {
  co_await make_changes();
  while ((pause_wanted || firmware_holds) && !stopped) co_await hold();
}

asio::awaitable<void> Session::State::make_changes() {
  while (!wanted.empty() && !stopped) {
    std::vector<std::string> lines(1, wanted.front());
    wanted.pop_front();
    modal.run(lines.front());
    co_await interpose(std::move(lines));
  }
}

bool Session::State::placed() const {
  return modal.position[0] && modal.position[1] && modal.position[2] && !modal.relative;
}

gcode::Pause Session::State::pause_here() const {
  return {modal, source.extent(), source.flow(), settings.pause_heat == PauseHeat::lower};
}

/// A firmware that has paused by itself parks and returns by itself: it only gets nothing more to do. Before
/// the first move there is nothing to go away from.
asio::awaitable<void> Session::State::hold() {
  const bool moving = !firmware_holds && placed();
  co_await go_aside(pause_wanted.value_or("the printer has paused itself"), moving);
  co_await wait_held();
  pause_wanted.reset();
  resume_wanted = firmware_holds = false;
  co_await come_back(moving);
}

/// With the printer in any state but that of a wait for heat.
asio::awaitable<void> Session::State::go_aside(std::string why, bool moving) {
  ++pauses;
  enter(SessionState::pausing, why);
  if (moving) {
    gcode::Chunk chunk = gcode::go_aside(source.printer(), pause_here());
    note_progress();
    way_aside = chunk.lines;
    if (spool) spool->journal().park(way_aside);
    co_await interpose(std::move(chunk.lines));
    co_await link.drain();
    note_progress();
    if (spool) spool->journal().aside();
  }
  hot_until = clock->now() + hot_patience;
  enter(SessionState::paused, why);
}

asio::awaitable<void> Session::State::come_back(bool moving) {
  if (stopped) co_return;
  enter(SessionState::resuming);
  tell_position();
  heating = true;  // a stop ends it
  if (moving) {
    std::vector<std::string> lines = gcode::come_back(source.printer(), pause_here()).lines;
    way_aside.insert(way_aside.end(), lines.begin(), lines.end());
    if (spool) spool->journal().park(way_aside);  // first: from now on the nozzle may be anywhere on it
    co_await interpose(std::move(lines));
  }
  if (moving && !stopped) co_await link.drain();
  heating = false;
  if (moving) cooled = false;
  co_await heat_again();
  if (stopped) co_return;
  if (moving && spool) spool->journal().park({});
  enter(SessionState::printing);
}

asio::awaitable<void> Session::State::wait_for(const Need& need) {
  const bool begun = state != SessionState::connecting;  // before that there is nothing to be steered
  const std::function<bool()> event = [&] {
    const bool steered = pause_wanted || firmware_holds || !wanted.empty();
    return need.come() || to_be_interrupted() || (begun && steered);
  };
  while (!need.come() && !to_be_interrupted()) {
    const TimePoint patient_until = clock->now() + idle_patience;
    while (!event() && clock->now() < patient_until) {
      if (need.look) co_await need.look();
      std::optional<Clock::Hold> hold;
      if (need.at_work) hold.emplace(*clock);
      co_await wake.wait(std::min(std::min(patient_until, need.at), clock->now() + look_interval), event);
    }
    if (event())
      co_await between();
    else
      co_await wait_aside(need);
  }
}

/// Lets the firmware know that somebody is there. Where nobody is for long, the nozzle cools until it goes
/// on.
asio::awaitable<void> Session::State::stay_aside(bool moved) {
  tell_position();
  co_await interpose(signs_of_life());
  const bool lower = settings.pause_heat == PauseHeat::lower;
  if (cooled || (lower && moved)) co_return;  // on the way aside
  if (!(lower && pause_wanted) && clock->now() < hot_until) co_return;
  cooled = true;
  tell(SessionEvent::Kind::notice, "the nozzle cools, and is heated before it goes on");
  std::vector<std::string> cool(1, gcode::cool_aside(modal));
  co_await interpose(std::move(cool));
}

/// A pause that was asked for meanwhile goes on when this is over. While nothing is laid yet, the nozzle may
/// stay where it is.
asio::awaitable<void> Session::State::wait_aside(const Need& need) {
  const bool moving = laying() && placed();
  const std::function<bool()> over = [&] {
    return to_be_interrupted() || (moving ? need.come() && !pause_wanted : need.come() || pause_wanted);
  };
  const std::function<bool()> event = [&] { return over() || !wanted.empty(); };
  lacking = moving;
  hot_until = clock->now() + hot_patience;
  if (moving) co_await go_aside(need.why, true);
  for (TimePoint sign = clock->now() + sign_of_life; !over();) {
    TimePoint next = sign;
    if (!need.come()) {
      if (need.look) co_await need.look();
      next = std::min(need.at, need.look ? clock->now() + look_interval : sign);
    }
    co_await wake.wait(next, event);
    if (state == SessionState::connecting) continue;
    co_await make_changes();
    if (clock->now() < sign) continue;
    sign = clock->now() + sign_of_life;
    co_await stay_aside(moving);
  }
  lacking = false;
  if (moving)
    co_await come_back(true);
  else
    co_await heat_again();
}

/// Where it has cooled without having been moved.
asio::awaitable<void> Session::State::heat_again() {
  if (!std::exchange(cooled, false) || stopped) co_return;
  heating = true;  // a stop ends it
  std::vector<std::string> lines(1, fmt::format("M109 S{:.0f}", modal.nozzle));
  co_await interpose(std::move(lines));
  if (!stopped) co_await link.drain();
  heating = false;
}

/// Until it is to go on. What is asked for meanwhile is done at once.
asio::awaitable<void> Session::State::wait_held() {
  const auto last = settings.longest_pause
                        ? clock->now() + std::chrono::duration_cast<Duration>(
                                             std::chrono::duration<double>(*settings.longest_pause))
                        : TimePoint::max();
  const std::function<bool()> ready = [this] { return resume_wanted || stopped || !wanted.empty(); };
  while (!resume_wanted && !stopped) {
    if (!co_await wake.wait(std::min(last, clock->now() + sign_of_life), ready)) {
      if (clock->now() >= last) co_return;
      if (!firmware_holds) co_await stay_aside(placed());
    }
    co_await make_changes();
  }
}

/// Told to the journal before they are sent: a printer that asks for one of them wants the print's next line.
asio::awaitable<void> Session::State::interpose(std::vector<std::string> lines) {
  gcode::keep_commands(lines);
  const std::uint64_t before = link.statistics().lines;
  extra += lines.size();
  interposing = true;
  if (spool && !parking) {
    const auto number = numbered.number + static_cast<std::uint32_t>(before + lines.size() - numbered.place);
    spool->journal().anchor({number, place}, false);
  }
  co_await link.send(std::move(lines));
  interposing = false;
}

/// M112 is read past the queue only by firmwares with an emergency parser; others read it when there is room.
asio::awaitable<void> Session::State::confirm_stop() {
  const std::function<bool()> confirmed = [this] { return halted; };
  reason = "stopped at once; reset the printer before using it again";
  if (co_await wake.wait(clock->now() + stop_patience, confirmed)) co_return;
  reason =
      pulse_reset(port)
          ? "stopped at once: the printer did not confirm it and was reset by its cable; look whether it "
            "stands still and cools, and switch it off if not"
          : "the printer was told to stop at once but has not confirmed it: it may read that only when it "
            "has done what is in its queue; switch it off by its own switch";
}

// ---- commands

void Session::State::stop(const std::string& why) {
  stopped = true;
  stop_reason = why;
  source.cancel();
  if (heating || link.waits_for_user()) link.cool_down();
  tell(SessionEvent::Kind::notice,
       heating ? "stopping: heating ends; once more stops the printer at once"
               : "stopping: the printer is parked and cooled; once more stops it at once");
  wake.notify();
}

Refusal Session::pause(const std::string& reason) {
  State& s = *state_;
  if (has_ended(s.state) || s.ending() || s.stopped) return over;
  if (s.pause_wanted || s.firmware_holds) return "it is paused already";
  s.pause_wanted = reason;
  s.tell(SessionEvent::Kind::notice, s.heating ? pause_when_hot : "it is held in a moment");
  return std::nullopt;
}

Refusal Session::resume() {
  State& s = *state_;
  if (s.stopped) return over;
  if (s.lacking && !s.pause_wanted) return "it waits for something: " + s.reason;
  if (!s.pause_wanted && !s.held()) return "it is not paused";
  s.go_on();
  return std::nullopt;
}

/// Whoever paused it does not want that any more.
void Session::State::go_on() {
  link.end_wait_for_user();
  if (firmware_holds || (held() && !lacking))
    resume_wanted = true;
  else
    pause_wanted.reset();
  wake.notify();
}

Refusal Session::cancel(const std::string& reason) {
  State& s = *state_;
  if (has_ended(s.state) || s.stopped) return over;
  if (s.state == SessionState::finishing) return "it is parking and cooling already";
  s.stop(reason);
  return std::nullopt;
}

Refusal Session::emergency_stop() {
  State& s = *state_;
  if (has_ended(s.state)) return "the print has ended";
  s.aborted = true;
  s.source.cancel();
  s.link.emergency_stop();
  s.wake.notify();
  return std::nullopt;
}

/// While it heats the printer obeys them only afterwards: it reads nothing before.
Refusal Session::State::change(const std::string& line) {
  if (has_ended(state) || ending() || stopped) return over;
  wanted.push_back(line);
  wake.notify();
  return std::nullopt;
}

Refusal Session::set_speed(double percent) {
  if (const Refusal no = outside("a speed of", percent, least_speed, most_speed, "%")) return no;
  if (const Refusal no = state_->change(fmt::format("M220 S{:.0f}", percent))) return no;
  state_->speed_percent = std::round(percent);
  return std::nullopt;
}

Refusal Session::set_flow(double percent) {
  if (const Refusal no = outside("a flow of", percent, least_flow, most_flow, "%")) return no;
  if (const Refusal no = state_->change(fmt::format("M221 S{:.0f}", percent))) return no;
  state_->flow_percent = std::round(percent);
  return std::nullopt;
}

Refusal Session::set_nozzle(double temperature) {
  if (const Refusal no = outside("a nozzle of", temperature, 0, hottest_nozzle, "°C")) return no;
  return state_->change(fmt::format("M104 S{:.0f}", temperature));
}

Refusal Session::set_bed(double temperature) {
  if (const Refusal no = outside("a bed of", temperature, 0, hottest_bed, "°C")) return no;
  return state_->change(fmt::format("M140 S{:.0f}", temperature));
}

/// A firmware drives on without laying anything, line by line.
void Session::State::hold_because_cold() {
  if (pause_wanted || firmware_holds || lacking || held() || ending() || stopped) return;
  pause_wanted =
      "the nozzle is too cold, the printer refuses to push filament: look at the heater before it goes on, "
      "and at the part, since the last lines were not laid";
  tell(SessionEvent::Kind::notice, "Error: " + *pause_wanted);
  wake.notify();
}

/// What a firmware asks for by `//action:`.
void Session::State::obey(const std::string& action) {
  const auto is = [&](const char* word) {
    return action == word || action.starts_with(std::string(word) + " ");
  };
  const bool paused = pause_wanted || firmware_holds;
  if (is("pause") && !paused && !ending() && !stopped) {
    pause_wanted = "the printer has asked for a pause (" + action + ")";
  } else if (is("paused") && !paused && !ending() && !stopped) {
    firmware_holds = true;
  } else if ((is("resume") || is("resumed")) && paused) {
    go_on();
  } else if (is("cancel") && !stopped && !ending()) {
    stop("the printer has asked for the end of the print");
  } else if (is("out_of_filament")) {
    tell(SessionEvent::Kind::notice, "the filament has run out (" + action + "): load more, then go on");
  }
  wake.notify();
}

}  // namespace unicursal::host
