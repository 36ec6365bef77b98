#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/cli/words.hpp"
#include "host/engine/simulator_process.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

std::vector<std::string> simulator_arguments(const DryRunCommand& command, const PreparedJob& prepared) {
  std::vector<std::string> arguments = {"--profile", prepared.job.profile.file.string(), "--speed",
                                        fmt::format("{}", command.speed)};
  if (command.job.outputs.pictures) {
    arguments.insert(arguments.end(), {"--picture", command.job.outputs.pictures->string()});
  }
  return arguments;
}

Comparison compare_with(const nlohmann::json& simulator, const Run& run, const StreamResult& result) {
  Fed fed;
  fed.filament_diameter = run.prepared().job.profile.printer.filament_diameter;
  fed.feeder_steps_per_mm = sim::SimulatorOptions{}.feeder_steps_per_mm;
  fed.lines_sent = result.statistics.lines;
  return compare(run.totals().materials, simulator, fed);
}

}  // namespace

Exit dry_run(const DryRunCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job);
  Run run(prepared, "dry-run", command.job.outputs);
  // Outlives the simulator, whose end is that of the stream it waits for.
  DepositCheck check(intended_mixtures(run), command.job.outputs.pictures);
  SimulatorProcess simulator(simulator_arguments(command, prepared));
  run.tell(check);
  check.watch(simulator.take_rasters());
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  check_beginning(prepared, lookahead);
  const int port = open_port(simulator.port(), prepared.job.profile.baud);
  const StreamResult result = stream_with_progress(port, lookahead, run, "dry run");
  if (result.ending == Ending::failed) conclude(run, result, {{"planning", planning_json(lookahead)}});
  const nlohmann::json seen = simulator.finish();
  check.finish();
  const MotionFindings motion = motion_findings(seen, prepared.job.flow);
  const Comparison comparison = compare_with(seen, run, result);
  conclude(run, result,
           {{"planning", planning_json(lookahead)},
            {"simulator", seen},
            {"comparison", to_json(comparison)},
            {"laid", check.to_json()},
            {"motion", to_json(motion)}});
  show(stdout, "{}", summary(run.totals(), lookahead.effort()));
  if (result.ending == Ending::stopped) {
    show(stdout, "stopped by the user\n");
    return Exit::failed;
  }
  show(stdout, "{}{}{}", summary(comparison), summary(motion), summary(check.total()));
  if (check.problem()) show(stderr, "warning: {}\n", *check.problem());
  return comparison.lines_whole() ? Exit::success : Exit::failed;
}

}  // namespace unicursal::host
