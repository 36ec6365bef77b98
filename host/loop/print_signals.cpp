#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

constexpr int ignored[] = {SIGUSR1, SIGUSR2,   SIGTSTP, SIGTTIN, SIGTTOU,
                           SIGALRM, SIGVTALRM, SIGPROF, SIGIO,   SIGPWR};

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

PrintSignals::PrintSignals(asio::signal_set& ending) {
  const bool hang_up = !is_ignored(SIGHUP);
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT, SIGXCPU}) ending.add(signal);
  if (hang_up) ending.add(SIGHUP);
  for (const int signal : ignored) {
    struct sigaction ignore {
    }, before{};
    ignore.sa_handler = SIG_IGN;
    if (sigaction(signal, &ignore, &before) == 0) before_.emplace_back(signal, before);
  }
}

PrintSignals::~PrintSignals() {
  for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
}

// A set whose signals nobody awaits counts them until somebody does.
NotedSignals::NotedSignals() : signals_(loop_), rules_(signals_) {}

bool NotedSignals::came() {
  bool one = false;
  for (bool more = true; more;) {
    more = false;
    signals_.async_wait([&](const asio::error_code& error, int) { more = !error; });
    loop_.restart();
    loop_.poll();
    one = one || more;
    if (more) continue;
    signals_.cancel();
    loop_.restart();
    loop_.poll();
  }
  return one;
}

}  // namespace unicursal::host
