#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/progress_line.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/sliced_production.hpp"
#include "host/engine/step_wait.hpp"
#include "host/files/whole_file.hpp"
#include "host/report/filament_use.hpp"
#include "host/report/open_books.hpp"

namespace unicursal::host {
namespace {

void write(WholeFile& file, const gcode::Chunk& chunk) {
  for (const std::string& line : chunk.lines) file.stream() << line << '\n';
}

/// Writes a slicer's file again, with the switches of mixture where a mixing nozzle needs them.
class Mix final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "mix", "Try without a printer",
                    "Turn the tools of a slicer's G-code into mixtures, for a card or another host.",
                    "unicursal mix part.gcode -o mixed.gcode");
    add_value(app, "JOB", job_.job, " ", "").required();
    job_.declare_sliced(app);
    app.get_option("JOB")->description("A slicer's .gcode, or a job that names one (see unicursal-job(5)).");
    add_value(app, "--profile", job_.profile, "PROFILE",
              "Use this printer profile instead of your own, or of the one that the job names.")
        .group("Job");
    app.add_flag_callback(
           "--no-look-ahead", [this] { job_.look_ahead = false; },
           "Switch mixtures where the slicer changes the tool, for comparison.")
        ->group("Job");
    add_value(app, "-o,--output", output_, "FILE", "The G-code file to write. Required.")
        .required()
        ->group("Output");
    add_value(app, "--report", job_.outputs.report, "FILE", "Write all measurements to this file, as JSON.")
        .group("Output");
    declare_quiet(app, job_.quiet);
    return app;
  }
  Exit run() override;

 private:
  JobOptions job_;
  std::filesystem::path output_;
};

Exit Mix::run() {
  const std::unique_ptr<Production> production = produce_and_warn(job_, {output_});
  if (!production->job().sliced) {
    throw core::DataError(job_.job.string(), "", "is not a slicer's G-code",
                          "write its G-code with `unicursal plan`");
  }
  const std::unique_ptr<Books> books = open_books(*production, "mix", job_.outputs);
  WholeFile file(output_);
  production->begin(real_clock(), {});
  Source& source = production->open({});
  write(file, source.start());
  {
    StepWait next(source);
    ProgressLine progress("mixing", job_.quiet ? 0 : source.layers());
    for (std::size_t done = 0;;) {
      next.wait();
      const std::optional<PrintStep> step = source.next();
      if (!step) break;
      write(file, step->chunk);
      for (const gcode::LayerShare& share : step->chunk.layers) done += share.last ? 1 : 0;
      progress.update(done, 0);
    }
  }
  write(file, source.finish());
  file.publish();
  books->write_report({{"ended", "completed"}});
  show_late_warnings(production->late_warnings());
  show(stdout, "{}{}written:   {}\n", job_.quiet ? "" : books->summary(std::nullopt),
       job_.quiet ? "" : used_filament(books->totals(), production->job().profile), output_.string());
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_mix() {
  return std::make_unique<Mix>();
}

}  // namespace unicursal::host
