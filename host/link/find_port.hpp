// Finds the serial port of a printer: by name, by USB numbers, or by asking all ports.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/link/link.hpp"

namespace unicursal::host {

/// Returns the ports that `wanted` can mean, the likeliest first. "1a86:7523" means the USB numbers of the
/// chip, in hexadecimal as lsusb writes them. "auto" means the ports on USB, with chips and boards of
/// printers first, or any port if there is none on USB. Anything else is a path, which need not be listed.
std::vector<PortInfo> matching_ports(const std::vector<PortInfo>& ports, std::string_view wanted);

/// Whether the ports that `wanted` can mean are asked before one of them is taken: several are, and one that
/// was found and is not on USB, since nobody knows what hangs on it.
bool must_answer(const std::vector<PortInfo>& meant, std::string_view wanted);

/// The name of a device that stays the same when its adapter is plugged in again, even if the device's own
/// name changes; empty if there is none. `folder` holds links to the devices.
std::string stable_name_of(const std::string& device,
                           const std::filesystem::path& folder = "/dev/serial/by-id");

/// Whether the kernel knows hardware behind a port. It lists serial ports that a board could have; `type` is
/// 0 (PORT_UNKNOWN) where it has found no chip (Documentation/ABI/testing/sysfs-tty). A port whose type is
/// not known counts. `folder` holds a folder for each port.
bool has_chip(const std::string& path, const std::filesystem::path& folder = "/sys/class/tty");

/// Opens all ports, asks all of them at once, and returns the descriptor of the first one that answers M115.
/// Opening a port may reset its board. Throws PortError if none can be opened or none answers.
int open_answering_port(const std::vector<PortInfo>& ports, unsigned baud);

}  // namespace unicursal::host
