#include "sim/stop_signals.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace unicursal::sim {

namespace {

volatile std::sig_atomic_t wake_up = -1;

extern "C" void on_stop_signal(int) {
  const int saved = errno;
  [[maybe_unused]] const auto written = ::write(wake_up, "!", 1);
  errno = saved;
}

}  // namespace

StopSignals::StopSignals() {
  int ends[2];
  if (::pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe for signals");
  }
  read_end_ = Descriptor(ends[0]);
  write_end_ = Descriptor(ends[1]);
  wake_up = ends[1];
  struct sigaction action {};
  action.sa_handler = on_stop_signal;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &old_interrupt_);
  ::sigaction(SIGTERM, &action, &old_terminate_);
}

/// A signal that comes while the last report is written must not cut it off, so the default action, which
/// ends the process, is not restored.
StopSignals::~StopSignals() {
  const auto restore = [](int signal, struct sigaction action) {
    if (action.sa_handler == SIG_DFL) action.sa_handler = SIG_IGN;
    ::sigaction(signal, &action, nullptr);
  };
  restore(SIGINT, old_interrupt_);
  restore(SIGTERM, old_terminate_);
}

}  // namespace unicursal::sim
