// What a job will take, before anything of it is planned: the areas of its layers times their heights. It
// leaves out what is laid beside the part (prime line, purges, skirt), travels and heating. s, g.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/prepared_job.hpp"
#include "host/engine/prepared_sliced.hpp"

namespace unicursal::host {

struct EstimatedFilament {
  std::string name, colour;
  double grams = 0;
};

struct JobEstimate {
  std::optional<double> seconds;             ///< absent: the flow is not known yet
  std::vector<EstimatedFilament> filaments;  ///< those that are fed
  std::size_t layers = 0;
};

/// Slices every layer. A core::StopScope around it is obeyed.
JobEstimate estimate_of(const PreparedJob& prepared);
/// From a slicer's own file: exact, except what remixing adds.
JobEstimate estimate_of(const PreparedSliced& prepared);

/// `seconds`, `grams` with `name`, `colour` and `grams`, and `layer_count`.
nlohmann::json to_json(const JobEstimate& estimate);

}  // namespace unicursal::host
