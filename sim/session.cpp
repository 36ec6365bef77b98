#include "sim/session.hpp"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unicursal::sim {

namespace {

/// If time leaps: real time from the opening of the line to the first message. A host that configures and
/// flushes its port meanwhile does not lose anything.
constexpr std::chrono::milliseconds boot_pause{50};
constexpr std::size_t much_output = 1 << 16;  // unsent bytes at which no more input is read
constexpr std::size_t most_output = 1 << 20;  // unsent bytes beyond which replies are lost
constexpr int events_between_looks = 16;      // leaps between two checks of the line
constexpr double longest_sleep = 3.6e6;       // ms

}  // namespace

Session::Session(const SimulatorOptions& options, Printer& printer,
                 std::function<void(const std::string&)> ready)
    : options_(options),
      printer_(printer),
      ready_(std::move(ready)),
      terminal_(std::make_unique<Terminal>(options.link)) {
  ready_(terminal_->path());
}

void Session::run() {
  while (!stopped_ && wait_for_host()) {
    open();
    serve();
    dtr_low_ = !terminal_ || terminal_->drops_dtr();
    output_.clear();
    if (printer_.unplugged()) {
      replug();
      continue;
    }
    terminal_->clear();
    if (options_.once && used_) break;
  }
}

// ---- time

double Session::present() const {
  return std::chrono::duration<double>(Clock::now() - start_).count() * options_.speed;
}

/// Time until the printer's next event, for poll(), ms; negative = for ever.
int Session::sleep_time() const {
  if (!paced() || !started_) return -1;
  std::optional<double> next = printer_.next_event();
  if (printer_.unplugged()) next = std::min(next.value_or(printer_.plug_time()), printer_.plug_time());
  if (!next) return -1;
  return static_cast<int>(
      std::clamp(std::ceil((*next - present()) / options_.speed * 1000), 0.0, longest_sleep));
}

void Session::keep_time() {
  if (!paced() || !started_) return;
  const double until = present();
  const bool was_unplugged = printer_.unplugged();
  while (printer_.now() < until && printer_.unplugged() == was_unplugged) {
    printer_.advance(until);
    output_ += printer_.take_output();
  }
  if (output_.size() > most_output) output_.resize(most_output);
}

void Session::leap() {
  for (int i = 0; i < events_between_looks && printer_.busy() && !printer_.unplugged(); ++i) {
    printer_.advance(*printer_.next_event());
    output_ += printer_.take_output();
  }
}

// ---- hosts

/// Returns false if a signal arrives first.
bool Session::wait_for_host() {
  for (;;) {
    terminal_->forget_openings();
    if (terminal_->host_present()) return true;
    pollfd waits[2] = {{stop_.descriptor(), POLLIN, 0}, {terminal_->openings(), POLLIN, 0}};
    ::poll(waits, 2, sleep_time());
    if (waits[0].revents != 0) return false;
    keep_time();
    output_.clear();  // nobody listens
  }
}

void Session::open() {
  if (!std::exchange(started_, true)) start_ = Clock::now();
  printer_.opened(dtr_low_);
  if (paced() || !printer_.firmware().booting()) return;
  pollfd wait{stop_.descriptor(), POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(boot_pause.count())) > 0) stopped_ = true;
  while (!stopped_ && printer_.firmware().booting() && !printer_.unplugged()) leap();
}

/// Runs until the host hangs up, the cable is pulled or a signal arrives.
void Session::serve() {
  hung_up_ = false;
  while (!stopped_ && !hung_up_) {
    terminal_->write(output_);
    if (printer_.unplugged()) return;
    wait_for_events(!paced() && printer_.busy() && output_.size() < much_output);
  }
}

void Session::wait_for_events(bool leaps) {
  const auto line_events =
      static_cast<short>((output_.size() < much_output ? POLLIN : 0) | (output_.empty() ? 0 : POLLOUT));
  pollfd waits[2] = {{stop_.descriptor(), POLLIN, 0}, {terminal_->master(), line_events, 0}};
  ::poll(waits, 2, leaps ? 0 : sleep_time());
  if (waits[0].revents != 0) stopped_ = true;
  keep_time();
  if ((waits[1].revents & (POLLIN | POLLHUP)) != 0) {
    const auto bytes = terminal_->read();
    hung_up_ = !bytes;
    if (!bytes) return;
    used_ = used_ || !bytes->empty();
    printer_.write(*bytes);
  } else if (leaps) {
    leap();
  }
}

/// The device disappears, and returns under a new name (behind the same link).
void Session::replug() {
  terminal_.reset();
  stopped_ = stopped_ || !std::isfinite(printer_.plug_time());
  while (!stopped_ && paced() && present() < printer_.plug_time()) {
    pollfd wait{stop_.descriptor(), POLLIN, 0};
    if (::poll(&wait, 1, sleep_time()) > 0) stopped_ = true;
    keep_time();
  }
  if (stopped_) return;
  if (!paced()) printer_.advance(printer_.plug_time());
  printer_.plug_in();
  dtr_low_ = true;
  terminal_ = std::make_unique<Terminal>(options_.link);
  ready_(terminal_->path());
}

}  // namespace unicursal::sim
