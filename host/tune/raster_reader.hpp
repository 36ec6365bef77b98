// Reads the strip from the simulator's raster as a person would from the bed: compares the bead with the
// reference lines of 5, 50 and 95 % and takes the nearest printed tick.
#pragma once

#include <array>
#include <vector>

#include "host/tune/reading.hpp"
#include "host/tune/strip_print.hpp"
#include "sim/bed/raster.hpp"

namespace unicursal::host {

class StripOnRaster final : public StripReader {
 public:
  StripOnRaster(const Strip& strip, const std::array<gcode::Mixture, shade_count>& mixtures);

  /// Reads a layer from the stream of rasters.
  void take(const sim::RasterFrame& frame, sim::RasterReader& rasters);

  StripReading read(const Strip& strip) override;

 private:
  struct Sample {
    core::Vec2 place{0, 0};
    double change = 0;  ///< share of the change at this place
    bool seen = false;  ///< plastic lies here
  };

  double change_in(const sim::RasterPixel& pixel) const;
  double change_around(std::size_t sample) const;
  double first_at_least(double change) const;

  std::array<gcode::Mixture, shade_count> mixtures_;
  std::array<Sample, 3> references_;
  std::vector<Sample> samples_;  ///< along the bead from the switch
};

}  // namespace unicursal::host
