// The link's input and output: reads, writes as much as the port takes, closes.
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/redirect_error.hpp>
#include <asio/use_awaitable.hpp>

#include "host/link/serial_log.hpp"
#include "host/link/state.hpp"

namespace unicursal::host {
namespace {

/// Number of waits for heat that a cool-down ends, one for each report of a wait: bed, nozzle, and those in
/// the user's own lines. It is limited, since a firmware without M108 would only queue them.
constexpr int most_interruptions = 4;

std::string lost(const asio::error_code& error) {
  return "the connection to the printer was lost (" + error.message() +
         "); check the cable and the printer's power";
}

}  // namespace

LinkState::LinkState(asio::any_io_executor on, int descriptor, LinkOptions with)
    : executor(std::move(on)),
      port(executor, descriptor),
      options(with),
      signal(executor, options.clock),
      ledger(options.receive_buffer, 1, options.last_number) {
  port.non_blocking(true);
  options.clock->attach(port.native_handle(), [this] { return statistics.bytes; });
}

asio::awaitable<void> LinkState::listen([[maybe_unused]] std::shared_ptr<LinkState> self) {
  std::array<char, 4096> buffer;
  for (;;) {
    asio::error_code ended;
    const std::size_t count =
        co_await port.async_read_some(asio::buffer(buffer), asio::redirect_error(asio::use_awaitable, ended));
    if (ended) {
      statistics.cut = true;
      fail(with_heat_warning(lost(ended)));
      co_return;
    }
    bytes_heard += count;
    if (options.log) options.log->add(SerialLog::Way::in, now(), {buffer.data(), count});
    splitter.feed({buffer.data(), count}, [this](std::string_view line) { hear(line); });
    pump();
    signal.notify();
  }
}

void LinkState::write(std::string_view text) {
  unsent += text;
  pump();
}

void LinkState::pump() {
  while (!waiting_for_port && !failure) {
    if (unsent.empty() && phase == Phase::streaming && !holding) {
      if (!ledger.in_flight()) last_ok = last_life = now();
      statistics.sent += ledger.fill(unsent);
    }
    if (unsent.empty()) return;
    asio::error_code error;
    const std::size_t count = port.write_some(asio::buffer(unsent), error);
    if (options.log && count > 0) options.log->add(SerialLog::Way::out, now(), {unsent.data(), count});
    unsent.erase(0, count);
    statistics.bytes += count;
    if (error == asio::error::interrupted) continue;  // a signal, as of Ctrl-C, has cut the call short
    if (error == asio::error::would_block || error == asio::error::try_again)
      wait_for_port();
    else if (error) {
      statistics.cut = true;
      fail(with_heat_warning(lost(error)));
    }
  }
}

void LinkState::wait_for_port() {
  waiting_for_port = true;
  port.async_wait(asio::posix::descriptor_base::wait_write,
                  [self = shared_from_this()](const asio::error_code& error) {
                    self->waiting_for_port = false;
                    if (!error) self->pump();
                    self->signal.notify();
                  });
}

/// The oks of these lines look like those of numbered lines; therefore `doubt` makes drain() probe at the
/// end.
void LinkState::cool_down() noexcept {
  try {
    if (failure || phase == Phase::greeting) return;
    statistics.lines -= ledger.forget_waiting();
    doubt = out_of_band = true;
    interruptions = most_interruptions;
    write("M108\nM104 S0\nM140 S0\n");
    asio::co_spawn(executor, limit_wait(shared_from_this(), ledger.next()), asio::detached);
    signal.notify();
  } catch (...) {
    // The numbered lines that end the print switch the heaters off as well.
  }
}

/// The ok of this line looks like that of a numbered line; therefore `doubt` makes drain() probe at the end.
void LinkState::write_past_queue(const std::string& line) {
  waits_for_user = false;
  doubt = out_of_band = true;
  prompt.answered();
  write(line + "\n");
  signal.notify();
}

void LinkState::end_wait_for_user() noexcept {
  try {
    if (failure || phase == Phase::greeting || !waits_for_user) return;
    // M108 does not end the wait for a choice.
    const auto button = prompt.shown() ? prompt.going_on() : std::nullopt;
    write_past_queue(button ? "M876 S" + std::to_string(*button) : "M108");
  } catch (...) {
    // The printer's own button can still end it.
  }
}

void LinkState::answer_prompt(std::size_t button) noexcept {
  try {
    if (failure || phase == Phase::greeting) return;
    write_past_queue("M876 S" + std::to_string(button));
  } catch (...) {
    // The printer's own button can still answer.
  }
}

void LinkState::emergency_stop() noexcept {
  try {
    const int descriptor = port.native_handle();
    if (options.clock->may_discard()) ::tcflush(descriptor, TCOFLUSH);
    constexpr std::string_view stop = "\nM112\n";  // the newline ends a half written line
    const auto written = ::write(descriptor, stop.data(), stop.size());
    statistics.bytes += static_cast<std::uint64_t>(std::max<ssize_t>(written, 0));
    fail("the printer was stopped by an emergency stop; switch it off and on again before the next print");
  } catch (...) {
    // This program cannot do more; the printer's own switch remains.
  }
}

void LinkState::close() {
  fail("the link was closed");
  listener = nullptr;  // its owner may no longer exist when further lines arrive
  options.clock->attach(-1, nullptr);
  asio::error_code ignored;
  port.close(ignored);
}

}  // namespace unicursal::host
