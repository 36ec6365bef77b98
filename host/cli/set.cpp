#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

class Set final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "set", "Daemon", "Change speed, flow or temperatures of the daemon's print.",
                    "unicursal set --flow 95 --nozzle 205");
    const auto option = [&](const char* name, std::optional<double>& value, const char* placeholder,
                            const char* help) {
      add_value(app, name, value, placeholder, help).check(number_between(0, 1000));
    };
    option("--speed", speed_, "PERCENT", "Speed as a percentage of the job's, 10 to 300.");
    option("--flow", flow_, "PERCENT", "Flow as a percentage of the job's, 50 to 200.");
    option("--nozzle", nozzle_, "CELSIUS", "Nozzle temperature, °C, until the job changes it.");
    option("--bed", bed_, "CELSIUS", "Bed temperature, °C, until the job changes it.");
    access_.declare(app);
    return app;
  }
  Exit run() override;

 private:
  std::optional<double> speed_, flow_, nozzle_, bed_;
  DaemonAccess access_;
};

Exit Set::run() {
  if (!speed_ && !flow_ && !nozzle_ && !bed_)
    throw DaemonError("", "set", "changes nothing", "give --speed, --flow, --nozzle or --bed with a number");
  const Client client = access_.connect();
  json heat = json::object();
  if (nozzle_) heat["nozzle_c"] = *nozzle_;
  if (bed_) heat["bed_c"] = *bed_;
  json status;
  if (!heat.empty()) status = accepted(client.ask("POST", "/api/temperature", heat));
  if (flow_) status = accepted(client.ask("POST", "/api/flow", {{"percent", *flow_}}));
  if (speed_) status = accepted(client.ask("POST", "/api/speed", {{"percent", *speed_}}));
  access_.show_status(status);
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_set() {
  return std::make_unique<Set>();
}

}  // namespace unicursal::host
