// OctoPrint's push channel: `/sockjs/websocket`, the plain WebSocket of SockJS, by which managers of many
// printers follow a printer. Messages as in docs/api/push.rst of OctoPrint 1.11 and src/octoprint/server/
// util/sockjs.py: `connected` at once; then the client says {"auth": "NAME:SESSION"} with the session that
// `POST /api/login` has given it, and gets `history`, `current` and `event`. Departures:
//
// - Before it has authenticated, a client gets `connected` only, and is let go after some seconds.
// - The framed transports of SockJS for browsers are not there.
// - Logs, markings and counts of resends are not sent; no plugins speak.
// - Of the events: PrinterStateChanged, PrintStarted, PrintPaused, PrintResumed, PrintDone, PrintFailed and
//   PrintCancelled.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "host/daemon/access.hpp"
#include "host/daemon/daemon.hpp"
#include "host/http/event_stream.hpp"

namespace unicursal::host {

/// What `POST /api/login` gives to clients that have shown a key, so that they need not send it by the
/// WebSocket. Sessions are in memory only; the oldest gives way.
class PushSessions {
 public:
  static constexpr std::size_t most = 256;

  /// A new one, which only this visitor knows.
  std::string open();
  /// `auth`: "NAME:SESSION".
  bool knows(const std::string& auth) const;
  /// All keys may be void.
  void clear() { sessions_.clear(); }

 private:
  std::deque<std::string> sessions_;
};

/// Serves one client from its first message on. `proven`: it has shown a key in its request, and need not
/// authenticate. `daemon` and `sessions` must live until the loop has stopped.
void push_to(EventStream& client, bool proven, Daemon& daemon, const PushSessions& sessions);

}  // namespace unicursal::host
