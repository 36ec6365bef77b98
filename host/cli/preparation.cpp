#include "host/cli/preparation.hpp"

#include <fmt/format.h>

#include <chrono>

#include "core/error.hpp"
#include "core/model/hanging.hpp"
#include "core/model/read_part.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/planned_production.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

/// Returns whether two names mean the same file, even if it does not exist yet. Devices count as different
/// files: they take any number of outputs.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const fs::file_status status = fs::status(a, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return false;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path real_a = fs::weakly_canonical(fs::absolute(a, error), error);
  const fs::path real_b = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && real_a == real_b;
}

/// What would be printed in the air. Slicing takes long for large parts, so that the look ends after a while;
/// the report of the print has all.
std::vector<std::string> hanging_places(const PreparedJob& prepared) {
  constexpr auto longest = std::chrono::seconds(5);
  if (!is_plate(prepared.job) && core::is_drawing_file(prepared.job.source.files.front()))
    return {};  // all layers are alike
  const auto end = std::chrono::steady_clock::now() + longest;
  core::HangingCheck check(prepared.job.bead_width);
  std::size_t seen = 0;
  for (; seen < prepared.count && std::chrono::steady_clock::now() < end; ++seen)
    check.add(prepared.part->layer(prepared.first + seen));
  std::vector<std::string> sentences = check.sentences();
  if (seen < prepared.count) {
    sentences.push_back(
        fmt::format("only {} of {} layers were searched for places in the air before the start, since the "
                    "part is large; --report lists all of them",
                    seen, prepared.count));
  }
  return sentences;
}

}  // namespace

void show_note(const std::string& sentence) {
  show(stderr, "note: {}\n", sentence);
}

void check_outputs(std::vector<fs::path> inputs, const std::vector<fs::path>& outputs) {
  std::vector<fs::path>& taken = inputs;
  for (const fs::path& output : outputs) {
    for (const fs::path& other : taken) {
      if (!same_file(output, other)) continue;
      throw core::DataError(output.string(), "",
                            "this output is the same file as " + other.string() + ", which would be lost",
                            "choose another name for it");
    }
    taken.push_back(output);
  }
}

std::vector<fs::path> present(std::initializer_list<std::optional<fs::path>> paths) {
  std::vector<fs::path> given;
  for (const auto& path : paths) {
    if (path) given.push_back(*path);
  }
  return given;
}

void show_late_warnings(const std::vector<std::string>& sentences) {
  for (const std::string& warning : sentences) show(stderr, "warning: {}\n", warning);
}

PreparedJob prepare_and_warn(const JobOptions& options, const std::vector<fs::path>& more_outputs,
                             UnnamedPrinter unnamed) {
  PreparedJob prepared = within_memory(options.job, [&] {
    Job job = load_job_or_model(options.job, options.profile, unnamed);
    job.print.look_ahead = options.look_ahead;
    job.full_quality = options.full_quality;
    job.allow_bare = job.allow_bare || options.allow_bare;
    return prepare(std::move(job), options.layers, [&](const std::string& note) {
      if (!options.quiet) show_note(note);
    });
  });
  prepared.threads = options.threads;
  std::vector<fs::path> outputs = more_outputs;
  if (options.outputs.report) outputs.push_back(*options.outputs.report);
  check_outputs(files_of(prepared.job).all(), outputs);
  for (const std::string& sentence : hanging_places(prepared)) show(stderr, "warning: {}\n", sentence);
  return prepared;
}

std::unique_ptr<Production> produce_and_warn(const JobOptions& options,
                                             const std::vector<fs::path>& more_outputs,
                                             UnnamedPrinter unnamed) {
  return std::make_unique<PlannedProduction>(prepare_and_warn(options, more_outputs, unnamed));
}

}  // namespace unicursal::host
