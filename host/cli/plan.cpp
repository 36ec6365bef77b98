#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/show.hpp"
#include "host/files/whole_file.hpp"
#include "host/report/print_report.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

/// A G-code file that is only there when it is whole.
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

}  // namespace

Exit plan(const PlanCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job, {command.output});
  Run run(prepared, "plan", command.job.outputs);
  check_beginning(prepared);
  GcodeFile file(command.output);
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
  show(stdout, "{}written:   {}\n", summary(run.totals(), lookahead.effort()), command.output.string());
  return Exit::success;
}

}  // namespace unicursal::host
