#include "host/engine/prepared_sliced.hpp"

#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/stopping.hpp"
#include "host/engine/temperature_limits.hpp"
#include "host/job/sliced_job.hpp"

namespace unicursal::host {
namespace {

gcode::SlicedLimits limits(bool allow_stops) {
  return {hottest_nozzle, hottest_bed, allow_stops};
}

}  // namespace

gcode::SlicedSurvey survey_of(const std::filesystem::path& file, const gcode::Printer& printer,
                              bool allow_stops) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw core::FileError(file.string(), "", "cannot be read", "check the path and its permissions");
  return gcode::survey_sliced(stream, file.string(), printer, limits(allow_stops),
                              [] { core::stop_point(); });
}

PreparedSliced prepare_sliced(Job job, const std::optional<LayerRange>& layers,
                              const std::function<void(const std::string&)>& note) {
  if (layers) {
    throw core::DataError("", "--layers", "cannot pick layers of a slicer's G-code",
                          "leave it out, and cut the part in the slicer");
  }
  PreparedSliced prepared;
  prepared.survey = survey_of(job.source.files.front(), job.profile.printer, job.sliced->allow_stops);
  choose_mixtures(job, prepared.survey);
  prepared.job = std::move(job);
  if (note) {
    for (const std::string& warning : prepared.job.warnings) note(warning);
    for (const std::string& sentence : prepared.survey.notes) note(sentence);
  }
  return prepared;
}

gcode::RemixSettings remix_settings(const PreparedSliced& prepared) {
  gcode::RemixSettings settings;
  settings.materials = prepared.job.print.materials;
  settings.tools = prepared.job.sliced->tools;
  settings.look_ahead = prepared.job.print.look_ahead;
  settings.leave_out_tower = !prepared.job.sliced->tower;
  settings.limits = limits(prepared.job.sliced->allow_stops);
  return settings;
}

}  // namespace unicursal::host
