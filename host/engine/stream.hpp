// From planned layers to a printer: one event loop with the link, the look-ahead and the signals.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

#include "host/engine/run.hpp"
#include "host/link/link.hpp"
#include "host/lookahead/lookahead.hpp"

namespace unicursal::host {

/// Something went wrong when the printer was already hot; it has been parked and cooled if it still listens.
class PrintError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StreamResult {
  bool stopped = false;  ///< by the user; the rest was not sent, the printer was parked and cooled
  LinkStatistics statistics;
  std::string firmware;  ///< as it names itself
};

struct StreamListeners {
  std::function<void(std::size_t layers, double fraction)>
      progress;                                     ///< layers begun, part of the present one sent
  std::function<void(const std::string&)> message;  ///< what the printer says, and what happens
};

/// Sends a whole print to the port, whose descriptor it takes over; blocks until every line is acknowledged.
/// SIGINT or SIGTERM once parks and cools, twice stops at once. Throws LinkError or PrintError.
StreamResult stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners);

}  // namespace unicursal::host
