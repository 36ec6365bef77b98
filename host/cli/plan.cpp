#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/progress_line.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/files/whole_file.hpp"
#include "host/report/filament_use.hpp"
#include "host/report/planned_books.hpp"
#include "host/report/print_report.hpp"

namespace unicursal::host {
namespace {

void write(WholeFile& file, const gcode::Chunk& chunk) {
  for (const std::string& line : chunk.lines) file.stream() << line << '\n';
}

class Plan final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "plan", "Try without a printer", "Write the G-code of a job to a file.",
                    "unicursal plan leaf.toml -o leaf.gcode");
    job_.declare(app);
    add_value(app, "-o,--output", output_, "FILE", "The G-code file to write. Required.")
        .required()
        ->group("Output");
    return app;
  }
  Exit run() override;

 private:
  JobOptions job_;
  std::filesystem::path output_;
};

Exit Plan::run() {
  const PreparedJob prepared = prepare_and_warn(job_, {output_});
  ChunkMaker maker(prepared);
  PlannedBooks books(maker, "plan", job_.outputs);
  check_beginning(prepared);
  WholeFile file(output_);
  write(file, maker.start());
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  {
    ProgressLine progress("planning", job_.quiet ? 0 : prepared.count);
    for (std::size_t done = 0; std::optional<PlannedLayer> layer = lookahead.wait(); ++done) {
      write(file, maker.layer(std::move(*layer)).chunk);
      progress.update(done, 1);
    }
  }
  check_bare(maker.bare(), prepared.job);
  write(file, maker.rest());
  write(file, maker.finish());
  file.publish();
  const Planning planning{lookahead.effort(), lookahead.threads()};
  books.write_report({{"ended", "completed"}, {"planning", planning_json(planning)}});
  show_late_warnings(maker.late_warnings());
  show(stdout, "{}{}written:   {}\n", job_.quiet ? "" : books.summary(planning),
       job_.quiet ? "" : used_filament(books.totals(), prepared.job.profile), output_.string());
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_plan() {
  return std::make_unique<Plan>();
}

}  // namespace unicursal::host
