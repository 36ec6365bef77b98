// Messages of a service to systemd over $NOTIFY_SOCKET (sd_notify(3)): ready, alive, stopping. Without that
// variable nothing is sent.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace unicursal::host {

/// Sends lines such as "READY=1\nSTATUS=idle"; best effort, as sd_notify(3) recommends.
void notify_service(const std::string& lines);

/// The interval for sending WATCHDOG=1, half of systemd's limit; absent if there is no watchdog.
std::optional<std::chrono::microseconds> watchdog_interval();

}  // namespace unicursal::host
