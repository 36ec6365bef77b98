#include "host/dry_run/dry_run.hpp"

#include <chrono>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/report/filament_use.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

class DryRun final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  JobOptions job_;
  SimulatedPrinter simulated_;
  double charge_ = 0;
  std::optional<std::filesystem::path> log_;
  DisplayOptions display_;
};

CLI::App& DryRun::declare(CLI::App& program) {
  CLI::App& app = add_command(program, "dry-run", "Try without a printer",
                              "Print a job on a simulated printer and show what would come out.",
                              "unicursal dry-run leaf.toml --report leaf.json --picture pictures");
  job_.declare(app);
  app.get_option("--picture")
      ->description(
          "Write pictures of each layer to this folder, and index.html, which shows them in a browser.");
  job_.declare_full_quality(app);
  job_.declare_sliced(app);
  declare_events(app, display_);
  declare_log(app, log_);
  add_value(app, "--charge-planning", charge_, "FACTOR",
            "In virtual time, let planning take as long as on a computer that is this many times slower. "
            "Default: 0, planning takes no time.")
      .check(number_between(0, 1e6))
      ->group("Planning");
  add_value(app, "--speed", simulated_.options.speed, "FACTOR",
            "Printer seconds per second: 1 is real time. Default: 0, virtual time, which runs as fast as "
            "possible and gives the same report every time.")
      .check(number_between(0, any_number))
      ->group("Simulated printer");
  simulated_.declare(app);
  return app;
}

Exit DryRun::run() {
  display_.quiet = job_.quiet;
  if (simulated_.personality) simulated_.options.personality = *simulated_.personality;
  simulated_.check();
  const std::unique_ptr<Production> production = produce_and_warn(job_, present({log_}));
  check_outputs(present({simulated_.options.fault_file}), present({job_.outputs.report, log_}));
  const DryRunOptions options{simulated_.options, simulated_.personality.has_value(), charge_, log_,
                              job_.outputs};
  StatusLook look = look_for(production->job());
  look.dry = true;
  ForegroundResult shown;
  const auto began = std::chrono::steady_clock::now();
  const DryRunResult result =
      dry_run(*production, options, [&](int port, Source& source, const StreamSettings& settings) {
        shown = stream_with_progress(port, source, display_, settings, look);
        return shown.stream;
      });
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::FILE* const messages = message_stream(display_);
  if (!display_.quiet) show(messages, "{}", result.summary);
  const Exit exit = show_ending(result.stream, display_);
  if (exit != Exit::success) return exit;
  if (!display_.quiet) show(messages, "{}{}", summary(result.comparison), result.laid_summary);
  for (const std::string& warning : result.warnings) show(stderr, "warning: {}\n", warning);
  if (!display_.quiet) show(messages, "{}", used_filament(result.totals, production->job().profile));
  show(messages, "done:      the print takes {} with heating{}; the dry run took {}\n",
       rough_duration(shown.seconds),
       shown.foretold ? " (" + rough_duration(*shown.foretold) + " were foretold)" : "",
       rough_duration(passed));
  if (result.problem) show(stderr, "warning: {}\n", *result.problem);
  return result.comparison.lines_whole() ? Exit::success : Exit::failed;
}

}  // namespace

std::unique_ptr<Command> make_dry_run() {
  return std::make_unique<DryRun>();
}

}  // namespace unicursal::host
