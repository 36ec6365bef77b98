// A session from outside: its public functions, and what the printer says.
#include <fmt/format.h>

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
    wake.notify();
    return announcer.event(SessionEvent::Kind::heat);
  }
  announcer.event(SessionEvent::Kind::printer, line);
  switch (remark.kind) {
    case Remark::Kind::unknown_m85:
      return announcer.warn(
          "this firmware does not know M85: if this computer fails in mid-print, nothing cools the printer");
    case Remark::Kind::too_cold:
      return holding.pause_because_cold();
    case Remark::Kind::action:
      return obey(remark.text);
    case Remark::Kind::no_mixing:
    case Remark::Kind::halted:
      return wake.notify();
    case Remark::Kind::temperatures:
    case Remark::Kind::other:
      break;
  }
}

/// Does what a firmware asks for by `//action:`.
void Session::State::obey(const std::string& action) {
  const auto is = [&](const char* word) {
    return action == word || action.starts_with(std::string(word) + " ");
  };
  if (is("pause")) {
    holding.pause_for_printer("the printer has asked for a pause (" + action + ")", PausedBy::session);
  } else if (is("paused")) {
    holding.pause_for_printer("the printer has paused itself", PausedBy::firmware);
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
  if (printer.may_wait_for_heat || link.waits_for_user()) link.cool_down();
  announcer.notice(
      printer.may_wait_for_heat
          ? "stopping: heating ends; a second Ctrl-C or `stop` stops the printer at once"
          : "stopping: the printer is parked and cooled; a second Ctrl-C or `stop` stops it at once");
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
  s.intent.abort();
  s.source.cancel();
  s.link.emergency_stop();
  s.wake.notify();
  return std::nullopt;
}

Refusal Session::set_speed(double percent) {
  if (const Refusal no = outside("a speed of", percent, least_speed, most_speed, "%")) return no;
  if (const Refusal no = state_->holding.change(fmt::format("M220 S{:.0f}", percent))) return no;
  state_->printer.speed_percent = std::round(percent);
  return std::nullopt;
}

Refusal Session::set_flow(double percent) {
  if (const Refusal no = outside("a flow of", percent, least_flow, most_flow, "%")) return no;
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
