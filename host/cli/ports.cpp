#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {
namespace {

class Ports final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    return add_command(program, "ports", "Print", "List the serial ports of this computer.",
                       "unicursal ports");
  }

  Exit run() override {
    const std::vector<PortInfo> found = list_ports();
    for (const PortInfo& port : found) {
      show(stdout, "{}  {}\n", port.path, port.description);
      if (!port.stable_path.empty()) show(stdout, "    {}\n", port.stable_path);
    }
    if (found.empty()) show(stdout, "no serial port found; is the printer plugged in and switched on?\n");
    return Exit::success;
  }
};

}  // namespace

std::unique_ptr<Command> make_ports() {
  return std::make_unique<Ports>();
}

}  // namespace unicursal::host
