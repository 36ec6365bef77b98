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

void write(WholeFile& file, const gcode::Chunk& chunk) {
  for (const std::string& line : chunk.lines) file.stream() << line << '\n';
}

}  // namespace

Exit plan(const PlanCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job, {command.output});
  ChunkMaker maker(prepared);
  Books books(maker, "plan", command.job.outputs);
  check_beginning(prepared);
  WholeFile file(command.output);
  write(file, maker.start());
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  {
    Progress progress("planning", prepared.count);
    for (std::size_t done = 0; std::optional<PlannedLayer> layer = lookahead.wait(); ++done) {
      write(file, maker.layer(std::move(*layer)).chunk);
      progress.update(done, 1);
    }
  }
  write(file, maker.rest());
  write(file, maker.finish());
  file.publish();
  books.write_report({{"ended", "completed"}, {"planning", planning_json(lookahead)}});
  show(stdout, "{}written:   {}\n", summary(books.totals(), lookahead.effort()), command.output.string());
  return Exit::success;
}

}  // namespace unicursal::host
