#include "host/engine/print.hpp"

#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/report/filament_use.hpp"
#include "host/report/open_books.hpp"
#include "host/report/print_report.hpp"

namespace unicursal::host {
namespace {

class PrintCommand final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  JobOptions job_;
  PrintOptions options_;
  DisplayOptions display_;
};

CLI::App& PrintCommand::declare(CLI::App& program) {
  CLI::App& app = add_command(program, "print", "Print",
                              "Print a job, a model or a slicer's G-code on a printer, over USB.",
                              "unicursal print leaf.toml --port /dev/ttyUSB0");
  job_.declare(app);
  job_.declare_full_quality(app);
  job_.declare_sliced(app);
  declare_port(app, options_.port, "the profile's port");
  declare_pause_heat(app, options_.pause_heat);
  declare_spool(app, options_.spool);
  declare_events(app, display_);
  declare_log(app, options_.log);
  add_steering_note(app);
  return app;
}

Exit PrintCommand::run() {
  display_.quiet = job_.quiet;
  Print print(produce_and_warn(job_, present({options_.log}), UnnamedPrinter::refuse), options_);
  const std::unique_ptr<Books> books = open_books(print.production(), "print", job_.outputs);
  print.connect();
  const ForegroundResult shown = stream_with_progress(print, display_);
  const StreamResult& result = shown.stream;
  note_in_history(print, shown);
  // The report does not wait for a terminal that is halted.
  try {
    const auto planning = print.production().planning();
    conclude(*books, result,
             planning ? nlohmann::json{{"planning", planning_json(*planning)}} : nlohmann::json::object());
  } catch (...) {
    show_how_to_resume(print.spool(), result);
    throw;
  }
  show_how_to_resume(print.spool(), result);
  show_late_warnings(print.production().late_warnings());
  if (result.ending == Ending::completed) {
    if (!display_.quiet)
      show(message_stream(display_), "{}{}", books->summary(print.production().planning()),
           used_filament(books->totals(), print.job().profile));
    show_done(shown, display_);
  }
  return show_ending(result, display_);
}

}  // namespace

std::unique_ptr<Command> make_print() {
  return std::make_unique<PrintCommand>();
}

}  // namespace unicursal::host
