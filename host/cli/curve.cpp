#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/report/curve_file.hpp"
#include "host/report/layer_log.hpp"
#include "host/report/peak_memory.hpp"
#include "host/report/picture_writer.hpp"
#include "host/report/stage_pictures.hpp"
#include "host/report/summary.hpp"
#include "host/report/target.hpp"

namespace unicursal::host {
namespace {

struct CurveOptions {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;
  std::size_t layer = 0;
  std::size_t island = 0;  ///< 0: the largest
  std::vector<std::filesystem::path> outputs;
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> pictures;  ///< folder for one picture of each stage
  int threads = 1;                                ///< threads that share the island
  core::Preset preset = core::Preset::best;
  double quality = 1;                           ///< multiplies the time limits of the optimisers
  std::optional<double> budget;                 ///< s of planning, after which the best curve is finished
  std::optional<std::filesystem::path> replay;  ///< a report whose step counts are used again
};

core::DataError no_effort(const std::filesystem::path& file) {
  return core::DataError(file.string(), "effort", "is not a list of whole numbers",
                         "name a file that `unicursal curve --report` has written");
}

/// Reads the step counts of an earlier report.
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

void apply(const CurveOptions& command, core::PlanOptions& options) {
  options.preset = command.preset;
  options.quality = command.quality;
  options.threads = command.threads;
  if (command.replay) options.recorded = effort_in(*command.replay);
  if (!command.budget) return;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(*command.budget);
  options.budget_spent = [end] { return std::chrono::steady_clock::now() >= end; };
}

PlannedLayer plan_one(const PreparedJob& prepared, const CurveOptions& command, core::Stages* stages) {
  const std::size_t island = command.island;
  PlannedLayer planned;
  planned.layer = prepared.part->layer(prepared.first);
  std::vector<core::Island>& islands = planned.layer.islands;
  if (island >= islands.size()) {
    throw core::DataError(
        "", "--island",
        fmt::format("layer {} has no island {}, but {} in all", prepared.first, island, islands.size()),
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

nlohmann::json curve_report(const CurveOptions& command, const PreparedJob& prepared,
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

Exit write_curves(const CurveOptions& command) {
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

class Curve final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override { return write_curves(options_); }

 private:
  CurveOptions options_;
};

CLI::App& Curve::declare(CLI::App& program) {
  CLI::App& app = add_command(program, "curve", "Try without a printer", "Write the curve of one island.",
                              "unicursal curve leaf.toml --layer 0 -o curve.txt -o curve.svg");
  add_note(
      app,
      "The formats are .txt (x y width of each vertex, in the frame of the part), .svg and .png. "
      "--picture shows how the curve comes about: the field, the cell graph, the first and the optimised "
      "cycle, the curve, and the bead widths.");
  add_value(app, "JOB", options_.job, " ",
            "The job, a TOML file (see unicursal-job(5)), or a model: .svg, .stl, .3mf, .obj or .amf.")
      .required();
  add_value(app, "--profile", options_.profile, "PROFILE",
            "Use this printer profile instead of the one that the job names.")
      .group("Job");
  add_value(app, "--layer", options_.layer, "N", "Layer, counted from 0. Default: 0.")
      .check(integer_between(0, 1'000'000'000))
      ->group("Job");
  add_value(app, "--island", options_.island, "K", "Island, counted from 0, the largest. Default: 0.")
      .check(integer_between(0, 1'000'000'000))
      ->group("Job");
  add_values(app, "-o,--output", options_.outputs, "FILE",
             "Write the curve to this file, in the format of its extension. May be repeated.")
      .group("Output");
  add_value(app, "--report", options_.report, "FILE", "Write all measurements to this file, as JSON.")
      .group("Output");
  add_value(app, "--picture", options_.pictures, "DIR",
            "Write a picture of each stage to this folder, from 1-field.png to 6-width.png.")
      .group("Output");
  add_value(app, "--threads", options_.threads, "N",
            "Number of threads that share the island. Default: 1. The result does not depend on it.")
      .check(integer_between(1, most_threads))
      ->group("Planning");
  const auto choose = [this](const std::string& word) {
    options_.preset = word == "paper" ? core::Preset::paper : core::Preset::best;
  };
  app.add_option_function<std::string>(
         "--preset", choose,
         "Weights, acceptance rule and population of the optimisers: best, or those of the paper. Default: "
         "best.")
      ->option_text("best|paper")
      ->check(one_of({"best", "paper"}))
      ->group("Planning");
  add_value(app, "--quality", options_.quality, "FACTOR",
            "Let the optimisers run this many times as long. Default: 1.")
      .check(number_between(0.01, 1000))
      ->group("Planning");
  add_value(app, "--budget", options_.budget, "SECONDS",
            "Time limit of planning. The best curve so far is then finished.")
      .check(number_between(0, 1e6))
      ->group("Planning");
  add_value(app, "--replay", options_.replay, "FILE",
            "Reproduce a curve exactly, using the step counts from its --report.")
      .group("Planning");
  return app;
}

}  // namespace

std::unique_ptr<Command> make_curve() {
  return std::make_unique<Curve>();
}

}  // namespace unicursal::host
