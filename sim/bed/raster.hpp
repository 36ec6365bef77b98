// The layers that a simulated printer has laid, as rasters, and the stream in which they leave it: beside
// simulator.hpp the whole of what a program reading them has to know. Facts only: how full each place is, and
// of what. The stream may be a file or a pipe; numbers are in this machine's byte order. mm.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace unicursal::sim {

struct RasterPixel {
  static constexpr std::size_t feeders = 6;
  static constexpr double whole = 65535;

  float fill = 0;                               ///< height of the plastic ÷ layer height; 1 is just full
  std::array<std::uint16_t, feeders> shares{};  ///< of the feeders in it, ÷ `whole`

  double share(std::size_t feeder) const { return shares[feeder] / whole; }
  /// Adds plastic as high as `amount` layer heights.
  void add(double amount, const std::array<double, feeders>& of);
};
static_assert(sizeof(RasterPixel) == 16);

/// Where a raster lies. Pixel (0, 0) is the one at `left`, `bottom`; y goes up.
struct RasterFrame {
  double z = 0;       ///< where the nozzle ran
  double height = 0;  ///< of the layer
  double left = 0, bottom = 0;
  double pixel = 0;  ///< side of one
  std::uint64_t columns = 0, rows = 0;

  double pixel_area() const { return pixel * pixel; }
};

class LayerRaster {
 public:
  virtual ~LayerRaster() = default;
  virtual RasterFrame frame() const = 0;
  /// `pixels` has frame().columns places; row 0 is the lowest.
  virtual void read_row(std::uint64_t row, std::span<RasterPixel> pixels) const = 0;
};

/// Takes the layers as they are finished.
class RasterSink {
 public:
  virtual ~RasterSink() = default;
  virtual void layer(const LayerRaster& raster) = 0;
};

class RasterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes every layer to a file or pipe. A reader that goes away ends the stream, not the simulation.
class RasterWriter : public RasterSink {
 public:
  /// Blocks until a pipe has a reader. Throws std::system_error when the file cannot be opened.
  explicit RasterWriter(const std::filesystem::path& file);
  ~RasterWriter() override;

  void layer(const LayerRaster& raster) override;

 private:
  bool write(const void* bytes, std::size_t count);

  int file_;
};

/// Reads such a stream layer by layer, row by row.
class RasterReader {
 public:
  /// Takes the descriptor over.
  explicit RasterReader(int descriptor) : file_(descriptor) {}
  ~RasterReader();
  RasterReader(const RasterReader&) = delete;
  RasterReader& operator=(const RasterReader&) = delete;

  /// The next layer, or nothing at the end. Precondition: all rows of the last one have been read. Throws
  /// RasterError for what is no such stream or ends in the middle.
  std::optional<RasterFrame> next();
  void read_row(std::span<RasterPixel> pixels);

 private:
  std::size_t read(void* bytes, std::size_t count);

  int file_;
};

}  // namespace unicursal::sim
