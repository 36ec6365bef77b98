// Sums over a plan, a print or a dry run. mm³, s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware_gcode/print/layer_mixing.hpp"
#include "host/report/figures.hpp"
#include "host/report/volumes.hpp"

namespace unicursal::host {

struct RunTotals {
  Figures figures;
  std::size_t layers = 0;
  double print_seconds = 0;        ///< estimated
  double flow = 0;                 ///< mm³/s that is held
  double volume = 0;               ///< extruded by all chunks
  std::uint64_t lines = 0;         ///< for the firmware, without comments
  std::size_t hurried_layers = 0;  ///< planned with less effort, so that the nozzle did not have to wait
  double least_effort = 1;         ///< the smallest fraction of the full effort
  std::vector<MaterialVolume> materials;
  std::vector<gcode::MixtureVolume> fed;    ///< by mixture, as the feeders were commanded
  std::vector<gcode::MixtureVolume> aside;  ///< of them, beside the part (Chunk::aside_mixtures)
  gcode::LayerMixing mixing;                ///< forecast of the schedule for all layers together
};

}  // namespace unicursal::host
