#include "host/engine/stream.hpp"

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>

namespace unicursal::host {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

class Foreground {
 public:
  Foreground(int port, Lookahead& lookahead, Run& run, const SessionObserver& observer,
             const StreamSettings& settings)
      : clock_(settings.clock),
        signals_(loop_, SIGINT, SIGTERM),
        session_(loop_.get_executor(), port, lookahead, run, settings) {
    if (!is_ignored(SIGHUP)) signals_.add(SIGHUP);
    session_.on_event([this, &observer](const SessionEvent& event) { observer(session_, event); });
  }

  StreamResult operator()() {
    await_signal();
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
      else if (signal != SIGHUP)
        session_.emergency_stop();
      stopped_ = true;
      await_signal();
    });
  }

  asio::io_context loop_{1};
  const std::shared_ptr<Clock> clock_;
  asio::signal_set signals_;
  Session session_;
  bool stopped_ = false;
};

}  // namespace

StreamResult stream(int port, Lookahead& lookahead, Run& run, const SessionObserver& observer,
                    const StreamSettings& settings) {
  return Foreground(port, lookahead, run, observer, settings)();
}

}  // namespace unicursal::host
