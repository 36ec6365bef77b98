// Which serial port a printer hangs on: by name, by its USB numbers, or by asking whoever is there.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/link/link.hpp"

namespace unicursal::host {

/// Those that `wanted` may mean, the likeliest first. "1a86:7523": the USB numbers of the chip, in
/// hexadecimal as lsusb writes them. "auto": ports on USB, chips and boards that printers have before others;
/// any port when there is none on USB. Anything else is a path, which need not be listed.
std::vector<PortInfo> matching_ports(const std::vector<PortInfo>& ports, std::string_view wanted);

/// The first of the ports behind which a printer answers M115, open; all are asked at once. Opening a port
/// may reset its board. Throws PortError when none can be opened or none answers.
int open_answering_port(const std::vector<PortInfo>& ports, unsigned baud);

}  // namespace unicursal::host
