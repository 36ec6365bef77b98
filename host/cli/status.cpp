#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"

namespace unicursal::host {
namespace {

class Status final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "status", "Daemon", "Show what the daemon is doing.", "unicursal status");
    access_.declare(app);
    return app;
  }

  Exit run() override {
    access_.show_status(accepted(access_.connect().ask("GET", "/api/status")));
    return Exit::success;
  }

 private:
  DaemonAccess access_;
};

}  // namespace

std::unique_ptr<Command> make_status() {
  return std::make_unique<Status>();
}

}  // namespace unicursal::host
