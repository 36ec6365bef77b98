// How plastic spreads under the nozzle, on a height raster of one layer at a time.
//
// The cross-section model: the nozzle runs at the layer's height, so plastic fills the room below it, the
// nearest place first, up to the layer's height and no higher. On open ground that gives a bead of
// rectangular section, volume ÷ (length × layer height) wide, with round ends. Beside a strand that lies
// there already the plastic gives way to the other side, and ahead, as far as `reach` times its half width on
// open ground. What finds no room there heaps up evenly where the bead lies, higher than the layer: overfill.
// Every mm³ stays in the raster (outside the bed's margin it is counted as lost). Departures from real melt:
// no pressure, viscosity, die swell or cooling; the layer below counts as flat.
//
// Memory: one layer, in tiles that exist where something lies. The pixel is the finest asked for with which
// the whole bed stays within 16 million pixels. mm, mm³.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/bed/raster.hpp"
#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

struct BedSize {
  double x = 200, y = 200;  ///< from 0
};

class Spread {
 public:
  static constexpr double reach = 1.5;

  Spread(const BedSize& bed, double finest_pixel);

  /// A new, empty layer.
  void begin(double z, double height);
  /// `width` mm: of the bead on open ground; of a drop it is its diameter.
  void lay(const Bead& bead, double width);
  /// What the layer has become; valid until the next begin().
  const LayerRaster& raster() const { return grid_; }
  bool empty() const { return grid_.empty(); }

  double pixel() const { return grid_.pixel; }
  /// Of all layers so far: laid outside the bed, so in no raster.
  double lost() const { return lost_; }

 private:
  struct Offset {
    int x, y;
    double distance;  ///< pixels
  };
  struct Tile {
    static constexpr int side = 64;
    std::vector<RasterPixel> pixels = std::vector<RasterPixel>(side * side);
  };
  struct Grid : LayerRaster {
    double pixel = 0, z = 0, height = 0;
    int across = 0, down = 0;                        ///< tiles
    int left = 0, bottom = 0, right = -1, top = -1;  ///< tiles in use
    std::vector<std::unique_ptr<Tile>> tiles;

    bool empty() const { return right < left; }
    void clear();
    /// Null outside the bed.
    RasterPixel* at(int x, int y);
    RasterFrame frame() const override;
    void read_row(std::uint64_t row, std::span<RasterPixel> pixels) const override;
  };

  void drop(double x, double y, double amount, double radius, const PerFeeder<double>& shares);
  double fill_room(int x, int y, double amount, double within, const PerFeeder<double>& shares);
  void heap(int x, int y, double amount, double within, const PerFeeder<double>& shares);

  Grid grid_;
  std::vector<Offset> offsets_;  ///< the nearest first
  double lost_ = 0;
};

}  // namespace unicursal::sim
