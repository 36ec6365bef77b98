#include "host/tune/raster_reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

constexpr double step = 0.1;       ///< mm between samples
constexpr std::size_t around = 4;  ///< samples to either side that are averaged, as an eye does

}  // namespace

StripOnRaster::StripOnRaster(const Strip& strip, const std::array<gcode::Mixture, shade_count>& mixtures)
    : mixtures_(mixtures) {
  for (std::size_t i = 0; i < references_.size(); ++i) references_[i].place = strip.references[i];
  const auto count = static_cast<std::size_t>(strip.length() / step);
  for (std::size_t i = 0; i < count; ++i) {
    samples_.push_back({strip.at(static_cast<double>(i) * step).place});
  }
}

double StripOnRaster::change_in(const sim::RasterPixel& pixel) const {
  double part = 0, whole = 0;
  for (std::size_t f = 0; f < mixtures_.front().feeders(); ++f) {
    const double from = mixtures_.front().share(f), way = mixtures_.back().share(f) - from;
    part += (pixel.share(f) - from) * way;
    whole += way * way;
  }
  return part / whole;
}

void StripOnRaster::take(const sim::RasterFrame& frame, sim::RasterReader& rasters) {
  std::vector<std::vector<Sample*>> by_row(frame.rows);
  const auto sort_in = [&](Sample& sample) {
    const double row = std::floor((sample.place.y() - frame.bottom) / frame.pixel);
    if (row >= 0 && row < static_cast<double>(frame.rows)) {
      by_row[static_cast<std::size_t>(row)].push_back(&sample);
    }
  };
  for (Sample& sample : references_) sort_in(sample);
  for (Sample& sample : samples_) sort_in(sample);
  std::vector<sim::RasterPixel> pixels(frame.columns);
  for (const std::vector<Sample*>& row : by_row) {
    rasters.read_row(pixels);
    for (Sample* sample : row) {
      const double column = std::floor((sample->place.x() - frame.left) / frame.pixel);
      if (column < 0 || column >= static_cast<double>(frame.columns)) continue;
      const sim::RasterPixel& pixel = pixels[static_cast<std::size_t>(column)];
      sample->seen = pixel.fill > 0;
      sample->change = change_in(pixel);
    }
  }
}

double StripOnRaster::change_around(std::size_t sample) const {
  const std::size_t first = sample < around ? 0 : sample - around;
  const std::size_t last = std::min(samples_.size() - 1, sample + around);
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i) sum += samples_[i].change;
  return sum / static_cast<double>(last - first + 1);
}

double StripOnRaster::first_at_least(double change) const {
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (change_around(i) >= change) return static_cast<double>(i) * step;
  }
  throw core::DataError("", "the strip", "still changes colour at its end",
                        "print again with a larger --range");
}

StripReading StripOnRaster::read(const Strip& strip) {
  const auto seen = [](const Sample& sample) { return sample.seen; };
  if (!std::all_of(samples_.begin(), samples_.end(), seen) ||
      !std::all_of(references_.begin(), references_.end(), seen)) {
    throw core::DataError("", "the strip", "was not printed from end to end", "print it again");
  }
  const auto tick_like = [&](std::size_t reference) {
    return nearest_tick(strip, first_at_least(references_[reference].change));
  };
  return {tick_like(0), tick_like(2), tick_like(1)};
}

}  // namespace unicursal::host
