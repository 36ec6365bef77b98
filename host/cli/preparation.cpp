#include "host/cli/preparation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <utility>

#include "core/error.hpp"
#include "core/model/hanging.hpp"
#include "core/model/read_part.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/planned_production.hpp"
#include "host/engine/produce.hpp"
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

namespace {

/// Loads the job with what the options change in it.
Job job_of(const JobOptions& options, UnnamedPrinter unnamed) {
  Job job = load_job_or_model(options.job, options.profile, unnamed);
  job.print.look_ahead = options.look_ahead;
  job.full_quality = options.full_quality;
  job.allow_bare = job.allow_bare || options.allow_bare;
  if ((options.no_tower || options.allow_stops) && !job.sliced) {
    throw core::DataError(job.file.string(), options.no_tower ? "--no-tower" : "--allow-stops",
                          "is only for a slicer's G-code", "leave it out");
  }
  if (job.sliced) {
    job.sliced->tower = job.sliced->tower && !options.no_tower;
    job.sliced->allow_stops = job.sliced->allow_stops || options.allow_stops;
  }
  return job;
}

void check_outputs_of(const Job& job, const JobOptions& options, std::vector<fs::path> outputs) {
  if (options.outputs.report) outputs.push_back(*options.outputs.report);
  check_outputs(files_of(job).all(), outputs);
}

std::function<void(const std::string&)> notes_for(const JobOptions& options) {
  return [quiet = options.quiet](const std::string& note) {
    if (!quiet) show_note(note);
  };
}

PreparedJob planned(Job job, const JobOptions& options, const std::vector<fs::path>& more_outputs) {
  PreparedJob prepared =
      within_memory(options.job, [&] { return prepare(std::move(job), options.layers, notes_for(options)); });
  prepared.threads = options.threads;
  check_outputs_of(prepared.job, options, more_outputs);
  for (const std::string& sentence : hanging_places(prepared)) show(stderr, "warning: {}\n", sentence);
  return prepared;
}

}  // namespace

PreparedJob prepare_and_warn(const JobOptions& options, const std::vector<fs::path>& more_outputs,
                             UnnamedPrinter unnamed) {
  Job job = within_memory(options.job, [&] { return job_of(options, unnamed); });
  if (job.sliced) {
    throw core::DataError(job.source.files.front().string(), "",
                          "is sliced already, so that no curve is planned",
                          "print it, try it with `unicursal dry-run`, or write it with `unicursal mix`");
  }
  return planned(std::move(job), options, more_outputs);
}

std::unique_ptr<Production> produce_and_warn(const JobOptions& options,
                                             const std::vector<fs::path>& more_outputs,
                                             UnnamedPrinter unnamed) {
  Job job = within_memory(options.job, [&] { return job_of(options, unnamed); });
  if (!job.sliced) return std::make_unique<PlannedProduction>(planned(std::move(job), options, more_outputs));
  check_outputs_of(job, options, more_outputs);
  return produce(std::move(job), options.layers, notes_for(options));
}

}  // namespace unicursal::host
