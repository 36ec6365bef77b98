// How plastic spreads under the nozzle, on a height raster of one layer at a time (sim/README.md, Physics).
//
// Model: the nozzle runs at the layer's height, so plastic fills the gap below it outwards from the centre
// line, up to the layer's height. On open ground a bead gets a rectangular section of the width
// volume ÷ (length × layer height), with round ends. Beside an older strand the plastic moves to the other
// side and ahead, at most `reach` times the bead's half width from the centre line. The rest piles up evenly
// where the bead lies, above the layer's height: overfill. Every mm³ stays in the raster; outside the bed's
// margin it is counted as lost. Departures from real melt: no pressure, viscosity, die swell or cooling; the
// layer below counts as flat.
//
// Memory holds one layer, in tiles that exist where plastic lies. A pixel has the size asked for, or is
// coarser so that the whole bed stays within 20 million pixels. mm, mm³.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/bed/raster.hpp"
#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

struct BedSize {
  double x = 200, y = 200;  ///< The bed reaches from 0 to here.
};

class Spread {
 public:
  static constexpr double reach = 1.5;

  /// `feeders`: as many as the printer has.
  Spread(const BedSize& bed, double finest_pixel, std::size_t feeders);

  /// Begins a new, empty layer.
  void begin(double z, double height);
  /// Lays a bead. `width` is its width on open ground, or the diameter of a drop, mm.
  void lay(const Bead& bead, double width);
  /// The current layer; valid until the next begin().
  const LayerRaster& raster() const { return grid_; }
  bool empty() const { return grid_.empty(); }

  double pixel() const { return grid_.pixel; }
  /// Volume laid outside the bed, in all layers so far.
  double lost() const { return lost_; }

 private:
  struct Offset {
    int x, y;
    double distance;  ///< Pixels.
  };
  struct Tile {
    static constexpr int side = 64;
    std::vector<RasterPixel> pixels = std::vector<RasterPixel>(side * side);
  };
  struct Grid : LayerRaster {
    double pixel = 0, z = 0, height = 0;
    int across = 0, down = 0;                        ///< Number of tiles in x and y.
    int left = 0, bottom = 0, right = -1, top = -1;  ///< Range of the tiles in use.
    std::vector<std::unique_ptr<Tile>> tiles;

    bool empty() const { return right < left; }
    void clear();
    /// Returns nullptr outside the bed's margin.
    RasterPixel* at(int x, int y);
    RasterFrame frame() const override;
    void read_row(std::uint64_t row, std::span<RasterPixel> pixels) const override;
  };

  /// A place to within an eighth of a pixel.
  struct Centre {
    int x, y;       ///< Pixel.
    int right, up;  ///< 1 or −1: to which side of the pixel's middle the place lies.
    bool swapped;   ///< Whether y lies farther from the middle than x.
    const std::vector<Offset>* offsets;

    RasterPixel* pixel(Grid& grid, const Offset& offset) const;
  };

  void drop(double x, double y, double amount, double radius, std::span<const double> shares);
  Centre centre(double x, double y);
  std::vector<Offset> around(int a, int b) const;
  double fill_room(const Centre& at, double amount, double within, std::span<const double> shares);
  void heap(const Centre& at, double amount, double within, std::span<const double> shares);

  Grid grid_;
  std::size_t feeders_;
  /// Pixels by their distance from a centre that lies `a` and `b` quarters of a pixel beside the middle of
  /// the pixel (0, 0), for 2 ≥ a ≥ b ≥ 0. Sorted by distance; made when needed.
  std::vector<Offset> offsets_[3][3];
  double lost_ = 0;
};

}  // namespace unicursal::sim
