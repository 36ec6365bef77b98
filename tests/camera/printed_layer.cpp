#include "tests/camera/printed_layer.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/bed/raster.hpp"

namespace unicursal::camera {

Rectangle PrintedLayer::printed() const {
  const auto none = std::numeric_limits<std::size_t>::max();
  std::size_t first_column = none, last_column = 0, first_row = none, last_row = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (fill[index(column, row)] < full / 2) continue;
      first_column = std::min(first_column, column), last_column = std::max(last_column, column);
      first_row = std::min(first_row, row), last_row = std::max(last_row, row);
    }
  }
  if (first_row == none) throw std::logic_error("the layer is empty");
  const auto at = [&](double origin, std::size_t count) {
    return origin + pixel * static_cast<double>(count);
  };
  return {at(left, first_column), at(bottom, first_row), at(left, last_column + 1), at(bottom, last_row + 1)};
}

PrintedLayer empty_layer(const Rectangle& place, double pixel, double height) {
  PrintedLayer layer;
  layer.left = place.left, layer.bottom = place.bottom, layer.pixel = pixel, layer.height = height;
  layer.columns = static_cast<std::size_t>(std::ceil(place.width() / pixel));
  layer.rows = static_cast<std::size_t>(std::ceil(place.height() / pixel));
  layer.fill.resize(layer.columns * layer.rows);
  layer.change.resize(layer.columns * layer.rows);
  return layer;
}

PrintedLayer read_layer(const std::filesystem::path& rasters, std::size_t from, std::size_t to) {
  const int descriptor = ::open(rasters.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw std::runtime_error(rasters.string() + " cannot be read");
  sim::RasterReader reader(descriptor);
  const auto frame = reader.next();
  if (!frame) throw std::runtime_error(rasters.string() + " holds no layer");
  PrintedLayer layer;
  layer.left = frame->left, layer.bottom = frame->bottom, layer.pixel = frame->pixel;
  layer.height = frame->height;
  layer.columns = frame->columns, layer.rows = frame->rows;
  layer.fill.resize(layer.columns * layer.rows);
  layer.change.resize(layer.columns * layer.rows);
  std::vector<sim::RasterPixel> row(layer.columns);
  double others = 0, plastic = 0;
  for (std::size_t y = 0; y < layer.rows; ++y) {
    reader.read_row(row);
    for (std::size_t x = 0; x < layer.columns; ++x) {
      if (row[x].fill <= 0) continue;
      const double first = row[x].share(from), second = row[x].share(to);
      others += 1 - first - second, plastic += 1;
      const auto level = std::lround(row[x].fill * PrintedLayer::full);
      layer.fill[layer.index(x, y)] = static_cast<std::uint8_t>(std::min(level, 255L));
      layer.change[layer.index(x, y)] = static_cast<std::uint16_t>(
          std::lround(second / std::max(first + second, 1e-9) * PrintedLayer::whole));
    }
  }
  layer.others = plastic > 0 ? std::max(0.0, others / plastic) : 0;
  return layer;
}

}  // namespace unicursal::camera
