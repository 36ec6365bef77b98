// A session's status, and the words for its states and events.
#include <algorithm>

#include "host/engine/seconds.hpp"
#include "host/engine/session_impl.hpp"

namespace unicursal::host {
const char* name(SessionState state) {
  switch (state) {
    case SessionState::connecting:
      return "connecting";
    case SessionState::heating:
      return "heating";
    case SessionState::printing:
      return "printing";
    case SessionState::pausing:
      return "pausing";
    case SessionState::paused:
      return "paused";
    case SessionState::resuming:
      return "resuming";
    case SessionState::finishing:
      return "finishing";
    case SessionState::cancelling:
      return "cancelling";
    case SessionState::done:
      return "done";
    case SessionState::stopped:
      return "stopped";
    case SessionState::failed:
      break;
  }
  return "failed";
}

const char* name(SessionEvent::Kind kind) {
  switch (kind) {
    case SessionEvent::Kind::state:
      return "state";
    case SessionEvent::Kind::progress:
      return "progress";
    case SessionEvent::Kind::heat:
      return "heat";
    case SessionEvent::Kind::notice:
      return "notice";
    case SessionEvent::Kind::printer:
      break;
  }
  return "printer";
}

Ahead Session::State::ahead() const {
  return {source.layers(), source.waiting(),
          [this](std::size_t begin, std::size_t end) { return source.foretold(begin, end); }};
}

/// Before the first layer it is known only while the printer heats, when all layers are foretold.
std::optional<double> Session::State::left() const {
  const SessionState state = announcer.state();
  if (has_ended(state)) return progress.has_begun() ? std::optional(0.0) : std::nullopt;
  // The targets are unknown until the lines that heat have been sent.
  const bool heats = state == SessionState::heating && printer.expected.nozzle > 0;
  const double heating = heats ? heat_forecast.left(printer.expected.nozzle, printer.expected.bed) : 0;
  if (progress.has_begun()) return heating + progress.seconds_left(ahead()) * 100 / printer.speed_percent;
  if (!heats) return std::nullopt;
  const auto printing = source.foretold(0, source.layers());
  return printing ? std::optional(heating + *printing) : std::nullopt;
}

SessionStatus Session::State::status() const {
  SessionStatus status;
  status.state = announcer.state();
  const bool when_hot = intent.paused_by_session() && status.state == SessionState::heating;
  status.reason = when_hot ? pause_when_hot : announcer.reason();
  status.layers = source.layers();
  status.layer = progress.layer(status.layers);
  status.layer_fraction = progress.fraction();
  if (progress.has_begun()) {
    status.percent = progress.percent(ahead(), status.state == SessionState::done);
  }
  status.left = left();
  status.elapsed = seconds(clock->now() - began);
  status.temperatures = printer.temperatures;
  status.job_nozzle = printer.job_nozzle;
  status.job_bed = printer.job_bed;
  status.mixture = printer.mixture;
  if (printer.prompt.shown()) status.prompt = {printer.prompt.text(), printer.prompt.buttons()};
  const Waiting waiting = source.waiting();
  status.lookahead = waiting.seconds;
  status.lookahead_layers = waiting.layers;
  if (const auto& queues = link.queues(); queues && queues->planner_size > 0)
    status.queue = 1 - static_cast<double>(queues->planner_free) / queues->planner_size;
  status.speed_percent = printer.speed_percent;
  status.flow_percent = printer.flow_percent;
  if (caught_up) status.warnings = source.warnings();
  const std::vector<std::string>& own = announcer.warnings();
  status.warnings.insert(status.warnings.end(), own.begin(), own.end());
  return status;
}

LinePlace Session::State::line_place() const {
  LinePlace place{leg().line(places.next()), leg().line(places.acknowledged()), std::nullopt};
  if (const auto& queues = link.queues(); queues && queues->planner_size > 0)
    place.queued_moves = queues->planner_size - std::min(queues->planner_size, queues->planner_free);
  return place;
}

LinePlace Session::line_place() const {
  return state_->line_place();
}

}  // namespace unicursal::host
