// Which other program has a serial port, from /proc (proc(5)): for messages to a person.
#pragma once

#include <optional>
#include <string>

namespace unicursal::host {

/// Returns the name and number of a process that has this device open, for example "pronsole (process 812)";
/// absent if that cannot be seen, for example since it belongs to another user.
std::optional<std::string> holder_of(const std::string& path);

/// Whether brltty runs, the driver of braille displays. It takes USB chips that printers use, too (CH340,
/// CP210x, FTDI), and the serial port then vanishes as soon as the printer is plugged in.
bool brltty_runs();

}  // namespace unicursal::host
