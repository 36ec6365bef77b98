#include <fmt/format.h>

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {

Exit ports() {
  const std::vector<PortInfo> found = list_ports();
  for (const PortInfo& port : found) {
    show(stdout, "{}  {}\n", port.path, port.description);
    if (!port.stable_path.empty()) show(stdout, "    {}\n", port.stable_path);
  }
  if (found.empty()) show(stdout, "no serial port found; is the printer plugged in and switched on?\n");
  return Exit::success;
}

}  // namespace unicursal::host
