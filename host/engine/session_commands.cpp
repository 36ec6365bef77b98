// A session from outside: its public functions, and what the printer says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/engine/reset_line.hpp"
#include "host/engine/session_impl.hpp"
#include "host/engine/temperature_limits.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto stop_patience = 2s;  ///< for the printer to confirm an emergency stop

constexpr double least_speed = 10, most_speed = 300;  ///< %
constexpr double least_flow = 50, most_flow = 200;    ///< %

constexpr auto too_cold =
    "the nozzle is too cold, so the printer refuses to push filament: check the heater before you resume, "
    "and the part, since the last lines were not laid";
constexpr auto too_long =
    "the printer takes an extrusion for a mistake, since it is longer than it allows, so it moves without "
    "laying anything: raise EXTRUDE_MAXLENGTH in its firmware or correct the job, and check the part before "
    "you resume";

/// Repetier takes a numbered line that has lost its checksum.
constexpr auto unchecked_damage =
    "the line to the printer is disturbed, and its firmware takes some damaged lines without a word, which "
    "this program cannot notice: look at the part, and use a better cable";

/// nullopt if the value is within its limits.
Refusal outside(const char* what, double value, double least, double most, const char* unit) {
  if (std::isfinite(value) && value >= least && value <= most) return std::nullopt;
  return fmt::format("{} {:g} {} is not between {:g} and {:g}", what, value, unit, least, most);
}

}  // namespace

// ---- what the printer says

void Session::State::hear(const std::string& line) {
  const Remark remark = printer.hear(line);
  if (remark.kind == Remark::Kind::temperatures) {
    watch_heat();
    if (announcer.state() == SessionState::heating) heat_forecast.note(clock->now(), printer.temperatures);
    holding.look_for_person();
    wake.notify();
    return announcer.event(SessionEvent::Kind::heat);
  }
  if (printer.display.hear(line)) return;
  announcer.quote(line);
  if (link.identity().family == gcode::Family::repetier && link.statistics().resends > 0)
    announcer.warn(unchecked_damage);
  switch (remark.kind) {
    case Remark::Kind::unknown_m85:
      return announcer.warn(
          "this firmware does not know M85: if this computer fails in mid-print, nothing cools the printer");
    case Remark::Kind::too_cold:
      return holding.pause_for_fault(too_cold);
    case Remark::Kind::too_long:
      return holding.pause_for_fault(too_long);
    case Remark::Kind::action:
      return obey(remark.text);
    case Remark::Kind::waits:
      return holding.printer_waits();
    case Remark::Kind::unknown:
      // Later ones may be lines that noise has changed.
      if (announcer.state() != SessionState::heating) break;
      return announcer.warn("the printer does not know one of the lines that prepare it (" + remark.text +
                            "): correct `start` in the profile's [gcode]");
    case Remark::Kind::no_such_tool:
    case Remark::Kind::no_mixing:
    case Remark::Kind::halted:
      return wake.notify();
    case Remark::Kind::temperatures:
    case Remark::Kind::other:
      break;
  }
}

/// While it prints, and while it waits for heat; pauses and the end have heat of their own.
void Session::State::watch_heat() {
  if (printer.may_wait_for_heat && !intent.ends()) {
    const auto trouble =
        warm_up_watch.note(clock->now(), printer.temperatures, printer.expected.nozzle, printer.expected.bed);
    if (trouble) give_up_heating(*trouble);
  } else {
    warm_up_watch.rest();
  }
  if (announcer.state() != SessionState::printing || printer.may_wait_for_heat) return heat_watch.rest();
  const auto trouble =
      heat_watch.note(clock->now(), printer.temperatures, printer.expected.nozzle, printer.expected.bed);
  if (trouble && trouble->meant) {
    printer.expected.bed = 0;
    return announcer.warn(trouble->why);
  }
  if (trouble) holding.pause_for_fault(trouble->why, trouble->what == HeatTrouble::hot);
}

/// Does what a firmware asks for by `//action:`.
void Session::State::obey(const std::string& action) {
  const auto is = [&](const char* word) {
    return action == word || action.starts_with(std::string(word) + " ");
  };
  if (is("pause")) {
    holding.pause_for_printer("the printer has asked for a pause (" + action + ")", PausedBy::session);
  } else if (is("paused")) {
    holding.pause_for_printer(action == "paused" ? "the printer has paused itself"
                                                 : "the printer has paused itself (" + action + ")",
                              PausedBy::firmware);
  } else if (printer.prompt.take(action)) {
    if (printer.prompt.shown() && link.waits_for_user()) holding.printer_waits();
    if (printer.prompt.buttons().size() > 1) announcer.notice(printer.prompt.sentence());
  } else if (is("resume") || is("resumed")) {
    holding.resume_for_printer();
  } else if (is("cancel") && !intent.ends() && !announcer.is_ending()) {
    stop("the printer has asked for the end of the print");
  } else if (is("out_of_filament")) {
    announcer.notice("the filament has run out (" + action + "): load more, then resume");
  }
  wake.notify();
}

// ---- stopping

void Session::State::stop(const std::string& reason) {
  intent.stop(reason);
  source.cancel();
  const bool waited = link.waits_for_user();
  if (waited) holding.printer_waits();
  if (printer.may_wait_for_heat || waited) link.cool_down();
  announcer.notice(
      printer.may_wait_for_heat
          ? "stopping, since " + reason +
                ": heating ends; a second Ctrl-C or `stop` stops the printer at once"
          : "stopping, since " + reason +
                ": the printer is parked and cooled; a second Ctrl-C or `stop` stops it at once");
  wake.notify();
}

/// Repetier acknowledges a wait for heat when it begins, and then reads nothing until it ends.
void Session::State::give_up_heating(const std::string& reason) {
  gave_up_heating = reason;
  if (link.identity().family == gcode::Family::repetier)
    stop_at_once();
  else
    stop(reason);
}

void Session::State::stop_at_once() {
  intent.abort();
  source.cancel();
  link.emergency_stop();
  wake.notify();
}

/// M112 is read past the queue only by firmwares with an emergency parser; others read it when there is room.
asio::awaitable<void> Session::State::confirm_stop() {
  const std::function<bool()> confirmed = [this] { return printer.halted; };
  announcer.explain("stopped at once; reset the printer before using it again");
  if (co_await wake.wait(clock->now() + stop_patience, confirmed)) co_return;
  announcer.explain(
      pulse_reset(port)
          ? "stopped at once: the printer did not confirm it and was reset by its cable; look whether it "
            "stands still and cools, and switch it off if not"
          : "an emergency stop was sent, but the printer has not confirmed it: it may read it only after "
            "it has done what is in its queue; switch it off by its own switch");
}

// ---- the public functions

Session::Session(asio::any_io_executor executor, int port, Source& source, StreamSettings settings)
    : state_(std::make_unique<State>(std::move(executor), port, source, std::move(settings))) {}

Session::~Session() = default;

asio::awaitable<StreamResult> Session::run() {
  std::exception_ptr error;
  try {
    co_await state_->print();
  } catch (...) {
    error = std::current_exception();
  }
  if (state_->intent.aborted()) co_await state_->confirm_stop();
  if (error && state_->intent.stopped() && state_->link.cut_wait_short()) {
    // Nothing is laid while it heats, so a printer that has been stopped at once is stopped well.
    co_await state_->confirm_stop();
    state_->announcer.notice("the printer did not end its heating: it was " + state_->announcer.reason());
    error = nullptr;
  }
  co_return state_->conclude(error);
}

StreamResult Session::failed(std::exception_ptr error) {
  state_->link.cool_down();
  return state_->conclude(error);
}

SessionStatus Session::status() const {
  return state_->status();
}

void Session::on_event(std::function<void(const SessionEvent&)> observer) {
  state_->announcer.observe(std::move(observer));
}

Refusal Session::pause(const std::string& reason) {
  return state_->holding.pause(reason);
}

Refusal Session::resume() {
  return state_->holding.resume();
}

Refusal Session::answer(std::size_t button) {
  return state_->holding.answer(button);
}

Refusal Session::cancel(const std::string& reason) {
  State& s = *state_;
  if (has_ended(s.announcer.state()) || s.intent.ends()) return ends_already;
  if (s.announcer.state() == SessionState::finishing) return "it is parking and cooling already";
  s.stop(reason);
  return std::nullopt;
}

Refusal Session::emergency_stop() {
  State& s = *state_;
  if (has_ended(s.announcer.state())) return "the print has ended";
  s.stop_at_once();
  return std::nullopt;
}

/// What the nozzle would have to push with these factors, against the profile's max_flow.
Refusal Session::State::too_much(double speed, double flow) const {
  constexpr double rounding = 1.001;
  const double pushed = source.flow() * speed * flow / 1e4, most = source.printer().max_flow;
  if (pushed <= std::max(most, source.flow()) * rounding) return std::nullopt;
  return fmt::format(
      "a speed of {:g} % with a flow of {:g} % would push {:.3g} mm³/s through a nozzle whose max_flow is "
      "{:g}; lower one of them",
      speed, flow, pushed, most);
}

Refusal Session::set_speed(double percent) {
  if (const Refusal no = outside("a speed of", percent, least_speed, most_speed, "%")) return no;
  if (const Refusal no = state_->too_much(percent, state_->printer.flow_percent)) return no;
  if (const Refusal no = state_->holding.change(fmt::format("M220 S{:.0f}", percent))) return no;
  state_->printer.speed_percent = std::round(percent);
  return std::nullopt;
}

Refusal Session::set_flow(double percent) {
  if (const Refusal no = outside("a flow of", percent, least_flow, most_flow, "%")) return no;
  if (const Refusal no = state_->too_much(state_->printer.speed_percent, percent)) return no;
  if (const Refusal no = state_->holding.change(fmt::format("M221 S{:.0f}", percent))) return no;
  state_->printer.flow_percent = std::round(percent);
  return std::nullopt;
}

Refusal Session::set_nozzle(double temperature) {
  if (const Refusal no = outside("a nozzle of", temperature, 0, hottest_nozzle, "°C")) return no;
  return state_->holding.change(fmt::format("M104 S{:.0f}", temperature));
}

Refusal Session::set_bed(double temperature) {
  if (const Refusal no = outside("a bed of", temperature, 0, hottest_bed, "°C")) return no;
  return state_->holding.change(fmt::format("M140 S{:.0f}", temperature));
}

}  // namespace unicursal::host
