// A printed layer, reduced to what a camera can see of it. mm, in the frame of the bed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace unicursal::camera {

struct Rectangle {
  double left = 0, bottom = 0, right = 0, top = 0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  bool holds(double x, double y) const { return x >= left && x <= right && y >= bottom && y <= top; }
};

struct PrintedLayer {
  static constexpr double full = 128;     ///< `fill` of a place that is exactly full
  static constexpr double whole = 65535;  ///< `change` of a place that holds the second feeder only

  double left = 0, bottom = 0, pixel = 0.05;
  double height = 0.2;  ///< layer height
  double others = 0;    ///< mean share of feeders besides both
  std::size_t columns = 0, rows = 0;
  /// Thickness ÷ layer height × `full`; rows go from front to back.
  std::vector<std::uint8_t> fill;
  /// Share of the second feeder in the plastic of both × `whole`.
  std::vector<std::uint16_t> change;

  std::size_t index(std::size_t column, std::size_t row) const { return row * columns + column; }
  /// The least rectangle around all plastic. Precondition: the layer is not empty.
  Rectangle printed() const;
};

/// An empty layer of that size.
PrintedLayer empty_layer(const Rectangle& place, double pixel, double height);

/// Reads what a simulated printer laid in its first layer (sim/bed/raster.hpp). Feeders are counted from 0.
/// Throws std::runtime_error if the file is not such a stream.
PrintedLayer read_layer(const std::filesystem::path& rasters, std::size_t from = 0, std::size_t to = 1);

}  // namespace unicursal::camera
