#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/cli/words.hpp"
#include "host/report/curve_file.hpp"

namespace unicursal::host {
namespace {

PlannedLayer plan_one(const PreparedJob& prepared, std::size_t island) {
  PlannedLayer planned;
  planned.layer = prepared.part->layer(prepared.first);
  std::vector<core::Island>& islands = planned.layer.islands;
  if (island >= islands.size()) {
    throw core::DataError(
        "", "--island",
        fmt::format("{} is none of the {} islands of layer {}", island, islands.size(), prepared.first),
        "islands are counted from 0, the largest first");
  }
  core::PlanOptions options = lookahead_options(prepared).plan;
  options.seed = island_seed(options.seed, planned.layer.index, island);
  planned.plans.push_back(prepared.planner->plan(islands[island], planned.layer.z, options));
  islands = {core::Island(islands[island])};
  return planned;
}

nlohmann::json curve_report(const CurveCommand& command, const PreparedJob& prepared,
                            const PlannedLayer& planned) {
  nlohmann::json report = to_json(measure(planned));
  report["job"] = command.job.string();
  report["layer"] = command.layer;
  report["island"] = command.island;
  report["z_mm"] = planned.layer.z;
  report["layer_height_mm"] = planned.layer.height;
  report["bead_width_mm"] = prepared.job.bead_width;
  report["island_area_mm2"] = core::area(planned.layer.islands.front().outline);
  report["peak_memory_mib"] = peak_memory();
  return report;
}

}  // namespace

Exit curve(const CurveCommand& command) {
  for (const std::filesystem::path& file : command.outputs) check_curve_file(file);
  const JobOptions options{
      command.job, command.profile, LayerRange{command.layer, command.layer}, {command.report, {}}};
  const PreparedJob prepared = prepare_and_warn(options, command.outputs);
  const PlannedLayer planned = plan_one(prepared, command.island);
  for (const std::filesystem::path& file : command.outputs) write_curve(file, planned, curve_style(prepared));
  if (command.report) write_json(*command.report, curve_report(command, prepared, planned));
  const Figures figures = measure(planned);
  show(stdout, "{} vertices, {:.1f} mm of curve {:.3f} mm apart over {:.2f} mm²\n", figures.vertices,
       figures.length, figures.mean_spacing(), figures.area);
  if (figures.curves == 0) show(stdout, "too thin, {:.2f} mm² not filled\n", figures.unfilled_area);
  return Exit::success;
}

}  // namespace unicursal::host
