#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/model_job.hpp"
#include "host/job/usual_profile.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

class New final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(program, "new", "Prepare a job",
                                "Write a job for a model, with one zone for each colour or body.",
                                "unicursal new leaf.svg -o leaf.toml");
    app.add_option("MODEL", files_, "The model: one .svg file, or .stl, .3mf, .obj and .amf files.")
        ->option_text(" ")
        ->required();
    add_value(app, "-o,--output", output_, "FILE",
              "The job file to write, which must not exist yet. Required.")
        .required();
    add_value(app, "--profile", profile_, "PROFILE",
              "Profile of the printer. Default: unicursal/printer.toml in ~/.config, or a common frame.");
    return app;
  }
  Exit run() override;

 private:
  std::vector<fs::path> files_;
  fs::path output_;
  std::optional<fs::path> profile_;
};

Exit New::run() {
  std::error_code error;
  if (fs::exists(output_, error)) {
    throw core::DataError(output_.string(), "", "this file exists already",
                          "choose another name, or delete it first");
  }
  const std::optional<fs::path> named = profile_ ? profile_ : own_profile();
  const fs::path profile = named ? *named : common_frame();
  const ModelJob job = model_job(files_, load_profile(profile), output_.parent_path());
  if (!named)
    show_note(
        "no profile is named: a common frame with a nozzle of 0.6 mm is assumed; change `printer` in the "
        "job");
  for (const std::string& note : job.contents.notes) show_note(note);
  write_whole_file(output_, job.text);
  show(stdout, "written: {}, with {} {}\n", output_.string(), job.contents.zones.size(),
       job.contents.zones.size() == 1 ? "zone" : "zones");
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_new() {
  return std::make_unique<New>();
}

}  // namespace unicursal::host
