#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/files/whole_file.hpp"
#include "host/report/print_report.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

/// A G-code file that appears under its name only when it is complete.
class GcodeFile {
 public:
  explicit GcodeFile(std::filesystem::path file) : file_(std::move(file)), stream_(open_draft(file_)) {}
  ~GcodeFile() {
    if (stream_.is_open()) discard_draft(stream_, file_);
  }
  GcodeFile(const GcodeFile&) = delete;
  GcodeFile& operator=(const GcodeFile&) = delete;

  void write(const gcode::Chunk& chunk) {
    for (const std::string& line : chunk.lines) stream_ << line << '\n';
  }
  void publish() { publish_draft(stream_, file_); }

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

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
  Run run(prepared, "plan", job_.outputs);
  check_beginning(prepared);
  GcodeFile file(output_);
  file.write(run.start());
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  {
    Progress progress("planning", prepared.count);
    for (std::size_t done = 0; std::optional<PlannedLayer> layer = lookahead.wait(); ++done) {
      file.write(run.layer(std::move(*layer)));
      progress.update(done, 1);
    }
  }
  file.write(run.rest());
  file.write(run.finish());
  file.publish();
  run.write_report({{"ended", "completed"}, {"planning", planning_json(lookahead)}});
  show(stdout, "{}written:   {}\n", summary(run.totals(), lookahead.effort()), output_.string());
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_plan() {
  return std::make_unique<Plan>();
}

}  // namespace unicursal::host
