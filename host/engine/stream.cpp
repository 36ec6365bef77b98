#include "host/engine/stream.hpp"

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/signal_set.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>

#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

/// Opens the terminal for itself, since O_NONBLOCK on the standard input would affect other programs that
/// share it. A program in the background gets an error instead of being stopped, since PrintSignals ignores
/// SIGTTIN. Returns −1 without a terminal.
int open_terminal() {
  if (::isatty(STDIN_FILENO) != 1) return -1;
  return ::open("/dev/tty", O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

class Foreground {
 public:
  Foreground(int port, Source& source, const SessionObserver& observer, const StreamSettings& settings,
             const SessionConsole& console)
      : clock_(settings.clock),
        signals_(loop_),
        signal_rules_(signals_),
        console_(console),
        stop_came_(settings.stop_came),
        terminal_(loop_),
        session_(loop_.get_executor(), port, source, settings) {
    session_.on_event([this, &observer](const SessionEvent& event) { observer(session_, event); });
  }

  StreamResult operator()() {
    await_signal();
    if (stop_came_ && stop_came_()) note_earlier_stop();
    if (const int terminal = console_ ? open_terminal() : -1; terminal >= 0) {
      terminal_.assign(terminal);
      await_words();
    }
    std::optional<StreamResult> result;
    asio::co_spawn(loop_, session_.run(), [&](const std::exception_ptr& error, StreamResult ended) {
      result = error ? session_.failed(error) : std::move(ended);
      loop_.stop();
    });
    try {
      clock_->run(loop_);
    } catch (...) {
      if (!result) result = session_.failed(std::current_exception());
    }
    return *result;
  }

 private:
  void await_signal() {
    signals_.async_wait([this](const asio::error_code& error, int signal) {
      if (error) return;
      if (!stopped_)
        session_.cancel();
      else if (PrintSignals::counts_again(signal))
        session_.emergency_stop();
      stopped_ = true;
      await_signal();
    });
  }

  /// One that came in this moment may have been seen here as well, and must not count twice.
  void note_earlier_stop() {
    loop_.poll();
    loop_.restart();
    if (!stopped_) session_.cancel();
    stopped_ = true;
  }

  void await_words() {
    terminal_.async_read_some(asio::buffer(typed_), [this](const asio::error_code& error, std::size_t count) {
      if (error) return;
      console_(session_, {typed_.data(), count});
      await_words();
    });
  }

  asio::io_context loop_{1};
  const std::shared_ptr<Clock> clock_;
  asio::signal_set signals_;
  const PrintSignals signal_rules_;
  const SessionConsole& console_;
  const std::function<bool()>& stop_came_;
  asio::posix::stream_descriptor terminal_;
  std::array<char, 256> typed_{};
  Session session_;
  bool stopped_ = false;
};

}  // namespace

StreamResult stream(int port, Source& source, const SessionObserver& observer, const StreamSettings& settings,
                    const SessionConsole& console) {
  return Foreground(port, source, observer, settings, console)();
}

}  // namespace unicursal::host
