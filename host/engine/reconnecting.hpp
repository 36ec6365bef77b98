// A print whose cable was pulled goes on when the printer is back: within some minutes, if the printer waits
// for the print's next line, its nozzle stands where the print left it, and it is still hot.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <chrono>
#include <stop_token>

#include "host/engine/print.hpp"

namespace unicursal::host {

/// How long a print waits for its printer to come back.
inline constexpr std::chrono::minutes reconnecting_patience{5};

/// Whether a print that ended like this may go on when its printer is back. If it was stopped, only its
/// heaters are switched off then.
inline bool may_reconnect(const StreamResult& result) {
  return result.ending == Ending::failed && result.statistics.cut && result.begun &&
         result.stop != StopAsked::at_once;
}

/// Opens the port again as soon as it is there; the print's session must be gone. Returns false when the time
/// is over, or `stop` was asked for. The port is opened on a thread of `opener`, which must be another than
/// the caller's. Throws core::DataError if the print cannot go on in this process.
asio::awaitable<bool> reconnect(Print& print, asio::any_io_executor opener, std::stop_token stop);

/// The same in the foreground; blocks. One of the signals that end a print ends the waiting.
bool reconnect_in_foreground(Print& print);

/// The result of a session that has found its printer again, but not where the print had left it.
StreamResult as_failure(StreamResult result);

}  // namespace unicursal::host
