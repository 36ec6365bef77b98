// What a session shows on the printer's own display, between two lines of the print.
#include "host/engine/session_impl.hpp"

namespace unicursal::host {
namespace {

PrinterDisplay::Moment moment_of(const Clock& clock) {
  return {clock.now(), std::chrono::system_clock::now()};
}

/// Its queue of moves is less than half full: now only moves count.
bool starves(const std::optional<PrinterQueues>& queues) {
  return queues && queues->planner_size > 0 && queues->planner_free > queues->planner_size / 2;
}

}  // namespace

/// A printer that waits for a person shows something that matters more.
asio::awaitable<void> Session::State::show_progress() {
  if (printer.display.rests(clock->now())) co_return;
  const bool prints = announcer.state() == SessionState::printing && intent.printing();
  if (!prints || link.waits_for_user() || starves(link.queues())) co_return;
  const PrinterDisplay::Progress now{progress.percent(ahead(), false), progress.layer(source.layers()),
                                     source.layers(), left()};
  std::vector<std::string> lines = printer.display.due(now, moment_of(*clock));
  co_await places.interpose(std::move(lines));
}

asio::awaitable<void> Session::State::show_end() {
  if (!settings.display) co_return;
  const bool completed = announcer.state() == SessionState::finishing;
  const bool cancelled = intent.stopped() && gave_up_heating.empty();
  // g++ 12 destroys the temporaries of a conditional expression in a co_await twice.
  std::vector<std::string> lines;
  if (completed)
    lines = printer.display.done(moment_of(*clock));
  else
    lines = printer.display.word(cancelled ? "Cancelled" : "Failed");
  co_await places.interpose(std::move(lines));
}

}  // namespace unicursal::host
