#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/daemon/job_check.hpp"

namespace unicursal::host {
namespace {

/// The daemon's child process (host/daemon/job_check.hpp). It is not listed by the help: `plan` checks a job
/// for people.
class CheckJob final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "check-job", "", "Read and check a job within limits, for the daemon.",
                    "unicursal check-job leaf.toml --memory 512 --time 10");
    add_value(app, "JOB", check_.job, " ", "Job to check.").required();
    add_value(app, "--profile", check_.profile, "PROFILE", "Use this printer profile.");
    declare_layers(app, check_.layers, "Check only these layers: A to B.");
    add_value(app, "--sketch", check_.sketch, "DIR",
              "Only write a picture and an estimate into this folder.");
    add_value(app, "--memory", memory_, "MB", "Address space that it may take.")
        .check(integer_between(16, most_megabytes));
    add_value(app, "--time", time_, "S", "Time that it may take.").check(integer_between(1, 86400));
    return app;
  }

  Exit run() override {
    if (memory_) check_.limits.memory = *memory_ * 1024 * 1024;
    if (time_) check_.limits.time = std::chrono::seconds(*time_);
    check_here(check_);
    return Exit::success;
  }

 private:
  static constexpr std::uint64_t most_megabytes = 1 << 24;

  JobCheck check_;
  std::optional<std::uint64_t> memory_;
  std::optional<std::uint32_t> time_;
};

}  // namespace

std::unique_ptr<Command> make_check_job() {
  return std::make_unique<CheckJob>();
}

}  // namespace unicursal::host
