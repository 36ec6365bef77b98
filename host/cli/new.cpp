#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/preparation.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/model_job.hpp"
#include "host/job/sliced_file.hpp"
#include "host/job/sliced_job.hpp"
#include "host/job/usual_profile.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

class New final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override {
    CLI::App& app = add_command(
        program, "new", "Prepare a job",
        "Write a job for a model, with one zone for each colour or body, or for a slicer's G-code.",
        "unicursal new leaf.svg -o leaf.toml");
    app.add_option("MODEL", files_,
                   "The model: one .svg file, or .stl, .3mf, .obj and .amf files; or one .gcode of a slicer.")
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

struct Written {
  std::string text;
  std::size_t zones = 0;
  std::vector<std::string> notes;
};

Written job_for(const std::vector<fs::path>& files, const fs::path& profile, const fs::path& folder) {
  const Profile printer = load_profile(profile);
  const bool sliced = std::any_of(files.begin(), files.end(), is_sliced_file);
  for (const fs::path& file : files) {
    refuse_binary_gcode(file);
    if (sliced && files.size() > 1) {
      throw core::DataError(file.string(), "",
                            "cannot be in one job with other files, since one is sliced already",
                            "write a job for each file");
    }
  }
  if (sliced) {
    const gcode::SlicedSurvey survey = survey_of(files.front(), printer.printer, true);
    return {sliced_job(files.front(), survey, printer, folder), survey.tools.size(), survey.notes};
  }
  ModelJob job = model_job(files, printer, folder);
  return {std::move(job.text), job.contents.zones.size(), std::move(job.contents.notes)};
}

Exit New::run() {
  std::error_code error;
  if (fs::exists(output_, error)) {
    throw core::DataError(output_.string(), "", "this file exists already",
                          "choose another name, or delete it first");
  }
  const std::optional<fs::path> named = profile_ ? profile_ : own_profile();
  const fs::path profile = named ? *named : common_frame();
  const Written job = job_for(files_, profile, output_.parent_path());
  if (!named)
    show_note(
        "no profile is named: a common frame with a nozzle of 0.6 mm is assumed; change `printer` in the "
        "job");
  for (const std::string& note : job.notes) show_note(note);
  write_whole_file(output_, job.text);
  show(stdout, "written: {}, with {} {}\n", output_.string(), job.zones, job.zones == 1 ? "zone" : "zones");
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_new() {
  return std::make_unique<New>();
}

}  // namespace unicursal::host
