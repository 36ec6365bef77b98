#include "core/model/inspect_model.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::host {
namespace {

class Inspect final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app =
        add_command(program, "inspect", "Prepare a job", "Show what a model holds, and whether it fits.",
                    "unicursal inspect leaf.svg");
    add_value(app, "MODEL", file_, " ", "The model: .svg, .stl, .3mf, .obj or .amf.").required();
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

Exit Inspect::run() {
  const core::ModelContents model = within_memory(file_, [&] { return core::inspect_model({file_}); });
  show_contents(model);
  if (model.notes.empty() && !model.drawing) show(stdout, "mended:  nothing\n");
  JobOptions options;
  options.job = file_;
  options.profile = profile_;
  try {
    const PreparedJob prepared = prepare_and_warn(options);
    const auto& printer = prepared.job.profile.printer;
    check_beginning(prepared);
    show(stdout, "fits:    yes, on \"{}\" ({:g} x {:g} x {:g} mm), in {} layers\n", printer.name,
         printer.bed[0], printer.bed[1], printer.bed[2], prepared.count);
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
