// A session in the foreground: an event loop of its own, and the signals of a terminal.
#pragma once

#include <functional>

#include "host/engine/session.hpp"

namespace unicursal::host {

/// Told of every event, and may steer the session.
using SessionObserver = std::function<void(Session&, const SessionEvent&)>;

using SessionConsole = std::function<void(Session&, const std::string& words)>;

/// Sends a whole print to the port, whose descriptor it takes over; blocks until it has ended. SIGINT or
/// SIGTERM once parks and cools, twice stops at once. SIGHUP, which a closed terminal may send twice, counts
/// as one of them at most, and not at all where it is ignored (nohup). Throws nothing: what goes wrong is
/// told in the result.
/// `console`: called with every line that is typed into the terminal that this program runs in, if it does in
/// one.
StreamResult stream(int port, Lookahead& lookahead, Run& run, const SessionObserver& observer,
                    const StreamSettings& settings = {}, const SessionConsole& console = {});

}  // namespace unicursal::host
