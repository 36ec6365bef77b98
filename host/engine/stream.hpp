// A session in the foreground, with an event loop of its own and the signals of a terminal.
#pragma once

#include <functional>
#include <string_view>

#include "host/engine/session.hpp"

namespace unicursal::host {

/// Called at every event; it may steer the session.
using SessionObserver = std::function<void(Session&, const SessionEvent&)>;

/// Called with what is typed, as the terminal gives it: whole lines, or single keys if it is set so.
using SessionConsole = std::function<void(Session&, std::string_view bytes)>;

/// Sends a whole print to the descriptor `port`, which it takes over; blocks until the print has ended. Does
/// not throw: a failure is in the result. SIGINT, SIGTERM, SIGQUIT or SIGHUP once parks and cools, a second
/// one stops at once; other signals are ignored (host/loop/print_signals.hpp). `console` gets what
/// is typed into the program's terminal, if it has one.
StreamResult stream(int port, Source& source, const SessionObserver& observer,
                    const StreamSettings& settings = {}, const SessionConsole& console = {});

}  // namespace unicursal::host
