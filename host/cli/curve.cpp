#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/report/curve_file.hpp"
#include "host/report/peak_memory.hpp"
#include "host/report/picture_writer.hpp"
#include "host/report/stage_pictures.hpp"
#include "host/report/summary.hpp"
#include "host/report/target.hpp"

namespace unicursal::host {
namespace {

core::DataError no_effort(const std::filesystem::path& file) {
  return core::DataError(file.string(), "effort", "is no list of whole numbers",
                         "name a file that `unicursal curve --report` has written");
}

/// The effort that an earlier report tells.
core::Effort effort_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  if (!report.is_object() || !report.contains("effort") || !report["effort"].is_array())
    throw no_effort(file);
  core::Effort effort;
  for (const nlohmann::json& steps : report["effort"]) {
    if (!steps.is_number_integer() || steps < 0 || steps > std::numeric_limits<int>::max())
      throw no_effort(file);
    effort.push_back(steps.get<int>());
  }
  return effort;
}

void apply(const CurveCommand& command, core::PlanOptions& options) {
  options.preset = command.preset;
  options.quality = command.quality;
  options.threads = command.threads;
  if (command.replay) options.recorded = effort_in(*command.replay);
  if (!command.budget) return;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(*command.budget);
  options.enough = [end] { return std::chrono::steady_clock::now() >= end; };
}

PlannedLayer plan_one(const PreparedJob& prepared, const CurveCommand& command, core::Stages* stages) {
  const std::size_t island = command.island;
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
  apply(command, options);
  options.stages = stages;
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
  report["effort"] = planned.plans.front().effort;
  report["looks"] = planned.plans.front().operations.looks;
  report["operations"] = planned.plans.front().operations.accepted;
  return report;
}

}  // namespace

Exit curve(const CurveCommand& command) {
  for (const std::filesystem::path& file : command.outputs) check_curve_file(file);
  const JobOptions options{
      command.job, command.profile, LayerRange{command.layer, command.layer}, {command.report, {}}};
  const PreparedJob prepared = prepare_and_warn(options, command.outputs);
  if (command.pictures) make_picture_folder(*command.pictures);
  core::Stages stages;
  const PlannedLayer planned = plan_one(prepared, command, command.pictures ? &stages : nullptr);
  for (const std::filesystem::path& file : command.outputs) write_curve(file, planned, curve_style(prepared));
  if (command.pictures) {
    const IslandStory story{planned.layer.islands.front(), stages, planned.plans.front()};
    write_stage_pictures(*command.pictures, story, curve_style(prepared));
  }
  if (command.report) write_json(*command.report, curve_report(command, prepared, planned));
  const Figures figures = measure(planned);
  show(stdout, "{} vertices, {:.1f} mm of curve {:.3f} mm apart over {:.2f} mm²\n", figures.vertices,
       figures.length, figures.mean_spacing(), figures.area);
  show(stdout, "{}", odd_widths(figures));
  if (figures.curves == 0) show(stdout, "too thin, {:.2f} mm² not filled\n", figures.unfilled_area);
  return Exit::success;
}

}  // namespace unicursal::host
