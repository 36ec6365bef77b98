// The part as it grows: sums over the beads of each layer. The beads themselves are passed on to be drawn and
// to be spread on the layer's raster. Memory holds one short record for each layer and no bead.
//
// A new layer begins when a bead ends at another z than the previous one. Its height is the distance from the
// previous layer, or, if the nozzle went down, from the nearest earlier layer below (from the bed if there is
// none). A drop (plastic pushed out while the nozzle stands still) does not begin a layer. It is spread if it
// lies at the z of the current layer; otherwise it is only counted. mm, mm³, s.
#pragma once

#include <limits>
#include <vector>

#include "sim/bed/raster.hpp"
#include "sim/bed/spread.hpp"
#include "sim/bed/strikes.hpp"
#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

struct DepositedLayer {
  double z = 0, height = 0;
  std::uint64_t beads = 0;
  double length = 0;   ///< Length of the beads.
  double seconds = 0;  ///< Time spent on the beads.
  double volume = 0;
  double travel = 0;  ///< Length of the travels to beads of this layer.
  std::uint64_t travels = 0;
};

struct Extents {
  double min_x = std::numeric_limits<double>::infinity(), min_y = min_x, min_z = min_x;
  double max_x = -min_x, max_y = -min_x, max_z = -min_x;

  bool empty() const { return min_x > max_x; }
  void include(const Position& place);
};

/// Receives beads with the record of their layer. `width` is volume ÷ (length · layer height), mm.
class BeadSink {
 public:
  virtual ~BeadSink() = default;
  virtual void bead(std::size_t layer, const DepositedLayer& about, const Bead& bead, double width) = 0;
};

class Deposit : public BedSink {
 public:
  struct Takers {
    BeadSink* drawing = nullptr;    ///< Receives every bead.
    Spread* spread = nullptr;       ///< Spreads the beads on the raster of the layer.
    RasterSink* rasters = nullptr;  ///< Receives every finished layer.
    Strikes* strikes = nullptr;     ///< Looks where the head strikes what was laid.
  };

  /// Each of the takers may be null.
  explicit Deposit(const Takers& takers) : takers_(takers) {}

  void laid(const Bead& bead) override;
  void travelled(const Position& from, const Position& to) override;

  /// To be called after the last bead: finishes the last layer.
  void finish();

  const std::vector<DepositedLayer>& layers() const { return layers_; }
  const Extents& extents() const { return extents_; }                ///< Extents of the beads' centre lines.
  double volume() const { return volume_; }                          ///< Volume of the beads.
  double dropped() const { return dropped_; }                        ///< Volume of the drops.
  const PerFeeder<double>& by_feeder() const { return by_feeder_; }  ///< Volume of beads and drops.
  double length() const { return length_; }
  double first_start() const { return first_start_; }  ///< Start of the first bead, s.
  double last_end() const { return last_end_; }        ///< End of the last bead, s.

 private:
  void drop(const Bead& bead);
  void begin_layer(double z);
  void settle_travel(DepositedLayer& layer);

  Takers takers_;
  std::vector<DepositedLayer> layers_;
  Extents extents_;
  double volume_ = 0, length_ = 0, dropped_ = 0;
  PerFeeder<double> by_feeder_{};
  double first_start_ = 0, last_end_ = 0;
  double travel_ = 0;      ///< Distance since the last bead.
  double last_width_ = 0;  ///< Width of the last bead.
};

}  // namespace unicursal::sim
