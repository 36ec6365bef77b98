// A job that prints a slicer's G-code, checked as far as possible without a printer: the file has been read
// to its end once, and nothing in it breaks the print.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "firmware_gcode/remix/remix.hpp"
#include "firmware_gcode/sliced/survey.hpp"
#include "host/engine/layer_range.hpp"
#include "host/job/job.hpp"

namespace unicursal::host {

struct PreparedSliced {
  Job job;  ///< with the mixtures of all tools
  gcode::SlicedSurvey survey;

  const std::filesystem::path& file() const { return job.source.files.front(); }
};

/// Looks at the file. `name`: of the file, for messages. Throws core::DataError.
gcode::SlicedSurvey survey_of(const std::filesystem::path& file, const gcode::Printer& printer,
                              bool allow_stops);

/// As prepare() (host/engine/prepared_job.hpp). Precondition: `job.sliced`.
PreparedSliced prepare_sliced(Job job, const std::optional<LayerRange>& layers = {},
                              const std::function<void(const std::string&)>& note = {});

gcode::RemixSettings remix_settings(const PreparedSliced& prepared);

}  // namespace unicursal::host
