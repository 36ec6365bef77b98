#include <chrono>
#include <thread>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

/// Waits until the daemon has read the part, which may still fail, and returns the job. A job that waits
/// again has a reason: its printer is off.
json started(const Client& client, std::uint64_t id) {
  constexpr auto look_again = std::chrono::milliseconds(200);
  const std::string path = fmt::format("/api/jobs/{}", id);
  json job = accepted(client.ask("GET", path));
  while (job.value("state", "") == "preparing" ||
         (job.value("state", "") == "queued" && !job.contains("reason"))) {
    std::this_thread::sleep_for(look_again);
    job = accepted(client.ask("GET", path));
  }
  return job;
}

class Start final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "start", "Daemon",
                                "Print the first job of the daemon's queue, or the job of this number.",
                                "unicursal start 3");
    add_value(app, "NUMBER", id_, " ", "Number of the job. Default: the first job of the queue.")
        .check(integer_between(0, std::numeric_limits<std::uint64_t>::max()));
    access_.declare(app);
    return app;
  }

  Exit run() override {
    const Client client = access_.connect();
    const json body = id_ ? json{{"id", *id_}} : json::object();
    const json begun = accepted(client.ask("POST", "/api/print/start", body));
    const json job = started(client, begun.at("id").get<std::uint64_t>());
    if (access_.json)
      show_json(job);
    else
      show(stdout, "job {}\n", job_text(job));
    const std::string state = job.value("state", "");
    return state == "failed" || state == "queued" ? Exit::failed : Exit::success;
  }

 private:
  std::optional<std::uint64_t> id_;
  DaemonAccess access_;
};

}  // namespace

std::unique_ptr<Command> make_start() {
  return std::make_unique<Start>();
}

}  // namespace unicursal::host
