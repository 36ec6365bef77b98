// How an idle printer carries out a command.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "host/idle/idle_state.hpp"

namespace unicursal::host {
namespace {

/// After the ok, of a firmware that says it when a line has come, and answers when it has run it.
constexpr auto late_place = std::chrono::minutes(3);
constexpr double barely_short = 3;  ///< °C below its target at which something still heats

bool heats(const std::optional<double>& actual, const std::optional<double>& target) {
  return actual && target && *target > 0 && *actual < *target - barely_short;
}

}  // namespace

/// The firmware needs no watch over what is cold.
std::vector<std::string> IdlePrinter::State::cold_lines() const {
  return {"M104 S0", "M140 S0", "M107", gcode::shut_down_after(0)};
}

asio::awaitable<void> IdlePrinter::State::send(std::vector<std::string> lines) {
  co_await link->send(std::move(lines));
  co_await link->drain();
}

asio::awaitable<void> IdlePrinter::State::perform(Step step) {
  current = std::move(step);
  changed();
  if (current->kind == Step::Kind::feed) {
    co_await feed(*current->feeding);
  } else {
    co_await send(current->lines);
    if (current->kind == Step::Kind::cool) {
      nozzle = bed = 0;
      may_be_hot = cools_first = false;
    }
    if (current->kind == Step::Kind::home || current->kind == Step::Kind::move) {
      last_motion = clock->now();
      co_await ask_place();
    }
    if (current->kind == Step::Kind::home) {
      for (std::size_t axis = 0; axis < known_axes.size(); ++axis)
        known_axes[axis] = known_axes[axis] || current->axes[axis];
    }
  }
  current.reset();
  changed();
}

asio::awaitable<void> IdlePrinter::State::ask_place() {
  heard_place.reset();
  std::vector<std::string> question(1, "M114");
  co_await send(std::move(question));
  const std::function<bool()> answered = [this] { return heard_place || failure || leave != Leave::no; };
  co_await wake.wait(clock->now() + late_place, answered);
  const bool moves_on = std::any_of(steps.begin(), steps.end(), [](const Step& step) {
    return step.kind == Step::Kind::move || step.kind == Step::Kind::home;
  });
  if (!moves_on) place = heard_place;
}

/// A session of its own, as for a print, since it knows how to end well; the port stays open meanwhile.
asio::awaitable<void> IdlePrinter::State::feed(const Feeding& made) {
  const int port_of_session = link->take_port();
  ++turn;
  link.reset();
  descriptor = ::fcntl(port_of_session, F_DUPFD_CLOEXEC, 0);
  FeedingSource source(made, profile.printer);
  StreamSettings settings;
  settings.clock = clock;
  settings.profile = profile.file;
  settings.link = link_options(profile, std::nullopt);
  settings.link.boot = {};
  session.emplace(executor, port_of_session, source, settings);
  session->on_event([this](const SessionEvent& event) {
    if (event.kind == SessionEvent::Kind::heat || event.kind == SessionEvent::Kind::state) {
      view.temperatures = session->status().temperatures;
      changed();
    }
    if (event.kind == SessionEvent::Kind::printer) quote(event.text);
    // Nobody could let it go on, and it would stay hot.
    if (event.kind == SessionEvent::Kind::state && session->status().state == SessionState::paused) {
      problem = session->status().reason;
      session->cancel(problem);
    }
  });
  const StreamResult result = co_await session->run();
  session.reset();
  note_feeding(result);
}

/// Throws LinkError if the connection was lost.
void IdlePrinter::State::note_feeding(const StreamResult& result) {
  known_axes = {};
  place.reset();
  nozzle = 0;
  fed = result.ending;
  last_command = clock->now();
  if (result.ending == Ending::failed) {
    problem = result.reason;
    may_be_hot = cools_first = !stopped;
    if (!result.statistics.cut && !stopped) return;
    ::close(std::exchange(descriptor, -1));
    throw LinkError(result.reason);
  }
}

// ---- what it is doing

bool IdlePrinter::State::hot() const {
  const auto on = [](const std::optional<double>& target) { return target && *target > 0; };
  return nozzle > 0 || bed > 0 || on(view.temperatures.nozzle_target) || on(view.temperatures.bed_target);
}

bool IdlePrinter::State::feeds() const {
  const auto is_feed = [](const Step& step) { return step.kind == Step::Kind::feed; };
  return (current && is_feed(*current)) || std::any_of(steps.begin(), steps.end(), is_feed);
}

IdleStatus::Action IdlePrinter::State::action() const {
  using Action = IdleStatus::Action;
  if (current && current->kind == Step::Kind::feed) return Action::feeding;
  if (current && current->kind == Step::Kind::home) return Action::homing;
  const gcode::Temperatures& now = view.temperatures;
  if (heats(now.nozzle, now.nozzle_target) || heats(now.bed, now.bed_target)) return Action::heating;
  return Action::none;
}

std::string IdlePrinter::State::doing() const {
  if (returning) return "it is looked for, since the connection was lost";
  if (link && link->waits_for_user()) return "the printer waits for a person: press its button";
  if (current && current->kind == Step::Kind::feed && session &&
      session->status().state == SessionState::heating)
    return current->doing + ": the axes home, and the nozzle heats";
  if (current && !current->doing.empty()) return current->doing;
  const gcode::Temperatures& now = view.temperatures;
  if (heats(now.nozzle, now.nozzle_target))
    return fmt::format("the nozzle heats to {:.0f} °C", *now.nozzle_target);
  if (heats(now.bed, now.bed_target)) return fmt::format("the bed heats to {:.0f} °C", *now.bed_target);
  return {};
}

}  // namespace unicursal::host
