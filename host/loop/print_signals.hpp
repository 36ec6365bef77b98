// Signals of a program that has a printer with hot heaters: none may kill it or halt it without the printer
// being parked and cooled. Exceptions are SIGKILL and SIGSTOP, which cannot be caught, and the signals of a
// crash.
#pragma once

#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>
#include <utility>
#include <vector>

namespace unicursal::host {

/// While an object of this class exists, signals that have nothing to do with a print are ignored, among them
/// those of Ctrl-Z (SIGTSTP) and SIGUSR1.
class PrintSignals {
 public:
  /// Adds the signals that ask for an end: SIGINT, SIGTERM, SIGQUIT, SIGXCPU, and SIGHUP unless it is ignored
  /// already (nohup).
  explicit PrintSignals(asio::signal_set& ending);
  ~PrintSignals();
  PrintSignals(const PrintSignals&) = delete;
  PrintSignals& operator=(const PrintSignals&) = delete;

  /// Whether this signal, as the second one, asks for a stop at once. A closed terminal may send SIGHUP
  /// twice, and the system sends SIGXCPU every second.
  static bool counts_again(int signal) { return signal != SIGHUP && signal != SIGXCPU; }

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
};

/// Lets no signal get lost, and none kill the program, between sessions of one print, and while one ends.
class NotedSignals {
 public:
  NotedSignals();
  /// Whether a signal that asks for an end has come since this was asked last, seen by a session or not.
  bool came();

 private:
  asio::io_context loop_{1};
  asio::signal_set signals_;
  const PrintSignals rules_;
};

}  // namespace unicursal::host
