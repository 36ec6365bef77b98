// What a service tells systemd over $NOTIFY_SOCKET (sd_notify(3)): that it is ready, alive, stopping. Without
// that variable nothing is told.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace unicursal::host {

/// Lines such as "READY=1\nSTATUS=idle". Best effort, as systemd itself wants it.
void notify_service(const std::string& lines);

/// How often WATCHDOG=1 is to be told, half of what systemd waits for; absent when it does not.
std::optional<std::chrono::microseconds> watchdog_interval();

}  // namespace unicursal::host
