#include "core/model/inspect_model.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/text/printable.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/job/load_job.hpp"
#include "host/job/sliced_file.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

class Inspect final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "inspect", "Prepare a job",
                                "Show what a model or a slicer's G-code holds, and whether it fits.",
                                "unicursal inspect leaf.svg");
    add_value(app, "MODEL", file_, " ", "The model: .svg, .stl, .3mf, .obj or .amf; or a slicer's .gcode.")
        .required();
    add_value(
        app, "--profile", profile_, "PROFILE",
        "Printer on which it is to fit. Default: unicursal/printer.toml in ~/.config, or a common frame.");
    return app;
  }
  Exit run() override;

 private:
  std::filesystem::path file_;
  std::optional<std::filesystem::path> profile_;
};

void show_contents(const core::ModelContents& model) {
  const Eigen::Vector3d& size = model.size;
  if (model.drawing) {
    show(stdout, "size:    {:.4g} x {:.4g} mm\nislands: {}, with {} {}\n", size.x(), size.y(), model.bodies,
         model.holes, model.holes == 1 ? "hole" : "holes");
  } else {
    show(stdout, "size:    {:.4g} x {:.4g} x {:.4g} mm\nbodies:  {}, of {} facets\n", size.x(), size.y(),
         size.z(), model.bodies, model.facets);
  }
  show(stdout, "zones:\n");
  for (const core::ZoneOffer& zone : model.zones) {
    show(stdout, "  select = \"{}\"  {:.4g} {}{}\n", zone.select, zone.amount, model.drawing ? "mm²" : "mm³",
         zone.paint ? " of paint" : "");
  }
}

void show_fit(const gcode::Printer& printer, std::size_t layers) {
  show(stdout, "fits:    yes, on \"{}\" ({:g} x {:g} x {:g} mm), in {} layers\n", printer.name,
       printer.bed[0], printer.bed[1], printer.bed[2], layers);
}

void show_contents(const PreparedSliced& file) {
  const gcode::SlicedSurvey& survey = file.survey;
  const core::Vec2 size = survey.extent.size();
  show(stdout, "slicer:  {}\n", survey.slicer.empty() ? "unknown" : core::printable(survey.slicer));
  show(stdout, "size:    {:.4g} x {:.4g} x {:.4g} mm, in layers of {:.3g} mm\n", size.x(), size.y(),
       survey.height, survey.layer_height);
  show(stdout, "tools:\n");
  for (const gcode::SlicedTool& tool : survey.tools) {
    const std::size_t material = file.job.sliced->tools.at(tool.number);
    show(stdout, "  T{}  {:.4g} mm³{}, printed as {}\n", tool.number, tool.volume,
         tool.colour.empty() ? "" : " of " + tool.colour,
         shares_text(file.job.print.materials.at(material).mixture));
  }
  show(stdout, "changes: {} of tool\n", survey.changes);
  if (survey.tower_volume > 0)
    show(stdout, "tower:   {:.4g} mm³ of {:.4g}; --no-tower leaves it out\n", survey.tower_volume,
         survey.volume);
  show(stdout, "time:    {}, without heating\n", duration_words(survey.seconds));
}

/// Throws core::DataError for what would break the print.
Exit inspect_sliced(const std::filesystem::path& file, const std::optional<std::filesystem::path>& profile) {
  try {
    const PreparedSliced prepared =
        prepare_sliced(load_job_or_model(file, profile, UnnamedPrinter::assume_common_frame), {}, show_note);
    show_contents(prepared);
    show_fit(prepared.job.profile.printer, prepared.survey.layers);
  } catch (const core::DataError&) {
    show(stdout, "fits:    no\n");
    throw;
  }
  return Exit::success;
}

Exit Inspect::run() {
  refuse_binary_gcode(file_);
  if (is_sliced_file(file_)) return inspect_sliced(file_, profile_);
  const core::ModelContents model = within_memory(file_, [&] { return core::inspect_model({file_}); });
  show_contents(model);
  if (model.notes.empty() && !model.drawing) show(stdout, "mended:  nothing\n");
  JobOptions options;
  options.job = file_;
  options.profile = profile_;
  try {
    const PreparedJob prepared = prepare_and_warn(options);
    check_beginning(prepared);
    show_fit(prepared.job.profile.printer, prepared.count);
  } catch (const core::DataError& error) {
    show(stdout, "fits:    no\n");
    throw;
  }
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_inspect() {
  return std::make_unique<Inspect>();
}

}  // namespace unicursal::host
