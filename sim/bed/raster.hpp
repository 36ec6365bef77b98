// The layers that a simulated printer has deposited, as rasters, and the stream in which they leave it. A
// reader of the stream needs only this header. The rasters hold facts: how full each place is, and of which
// feeders' plastic. The stream may be a file or a pipe; numbers are in this machine's byte order. mm.
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
  static constexpr std::size_t feeders = 8;
  static constexpr double whole = 65535;

  float fill = 0;                               ///< Height of the plastic ÷ layer height; 1 = exactly full.
  std::array<std::uint16_t, feeders> shares{};  ///< Share of each feeder × `whole`.

  double share(std::size_t feeder) const { return shares[feeder] / whole; }
  /// Adds plastic of the shares `of`, those of the first feeders, with a height of `amount` layer heights.
  void add(double amount, std::span<const double> of);
};
static_assert(sizeof(RasterPixel) == 20);

/// Position and size of a raster. Pixel (0, 0) is at `left`, `bottom`; y goes up.
struct RasterFrame {
  double z = 0;       ///< Height of the nozzle.
  double height = 0;  ///< Layer height.
  double left = 0, bottom = 0;
  double pixel = 0;  ///< Side of a pixel.
  std::uint64_t columns = 0, rows = 0;

  double pixel_area() const { return pixel * pixel; }
};

class LayerRaster {
 public:
  virtual ~LayerRaster() = default;
  virtual RasterFrame frame() const = 0;
  /// Copies one row into `pixels`, which has frame().columns elements. Row 0 is the lowest.
  virtual void read_row(std::uint64_t row, std::span<RasterPixel> pixels) const = 0;
};

/// Receives the layers as they are finished.
class RasterSink {
 public:
  virtual ~RasterSink() = default;
  virtual void layer(const LayerRaster& raster) = 0;
};

class RasterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes every layer to a file or pipe. If the reader closes the pipe, the stream ends and the simulation
/// continues.
class RasterWriter : public RasterSink {
 public:
  /// Blocks until a pipe has a reader. Throws std::system_error if the file cannot be opened.
  explicit RasterWriter(const std::filesystem::path& file);
  ~RasterWriter() override;

  void layer(const LayerRaster& raster) override;

 private:
  bool write(const void* bytes, std::size_t count);

  int file_;
};

/// Reads the stream of a RasterWriter layer by layer, row by row.
class RasterReader {
 public:
  /// Takes ownership of the descriptor.
  explicit RasterReader(int descriptor) : file_(descriptor) {}
  ~RasterReader();
  RasterReader(const RasterReader&) = delete;
  RasterReader& operator=(const RasterReader&) = delete;

  /// Returns the next layer's frame, or nullopt at the end. Precondition: all rows of the previous layer have
  /// been read. Throws RasterError if the stream has another format or ends within a layer.
  std::optional<RasterFrame> next();
  void read_row(std::span<RasterPixel> pixels);

 private:
  std::size_t read(void* bytes, std::size_t count);

  int file_;
};

}  // namespace unicursal::sim
