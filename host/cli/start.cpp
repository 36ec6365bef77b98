#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

class Start final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "start", "Daemon",
                                "Print the first job of the daemon's queue, or the job of this number.",
                                "unicursal start 3");
    add_value(app, "NUMBER", id_, " ", "Number of the job. Default: the first job of the queue.")
        .check(integer_between(0, std::numeric_limits<std::uint64_t>::max()));
    app.add_flag("--bed-clear", bed_clear_,
                 "Start although a print was interrupted: its part was taken off the bed.");
    access_.declare(app);
    return app;
  }

  Exit run() override {
    const Client client = access_.connect();
    json body = json::object();
    if (id_) body["id"] = *id_;
    if (bed_clear_) body["bed_clear"] = true;
    const json begun = accepted(client.ask("POST", "/api/print/start", body));
    const json job = begun_job(client, begun.at("id").get<std::uint64_t>());
    if (access_.json)
      show_json(job);
    else
      show(stdout, "job {}\n", job_text(job));
    const std::string state = job.value("state", "");
    return state == "failed" || state == "queued" ? Exit::failed : Exit::success;
  }

 private:
  std::optional<std::uint64_t> id_;
  bool bed_clear_ = false;
  DaemonAccess access_;
};

}  // namespace

std::unique_ptr<Command> make_start() {
  return std::make_unique<Start>();
}

}  // namespace unicursal::host
