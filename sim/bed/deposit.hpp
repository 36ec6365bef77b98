// The part as it grows: every bead, summed up by layer, and the beads themselves passed on to be drawn and to
// be spread on the layer's raster. Memory holds one short record for each layer and no bead. A new layer
// begins whenever a bead ends at another height than the one before; its height is the way up from the layer
// before, or, after a way down, from the nearest earlier layer below it (from the bed when there is none). A
// drop, pushed out while the nozzle stands, begins no layer; it lies in the present one if it fell at its
// height, otherwise it is only counted. mm, mm³, s.
#pragma once

#include <limits>
#include <vector>

#include "sim/bed/raster.hpp"
#include "sim/bed/spread.hpp"
#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

struct DepositedLayer {
  double z = 0, height = 0;
  std::uint64_t beads = 0;
  double length = 0;   ///< of beads
  double seconds = 0;  ///< spent on them
  double volume = 0;
  double travel = 0;  ///< length of the travels before beads of this layer
  std::uint64_t travels = 0;
};

struct Extents {
  double min_x = std::numeric_limits<double>::infinity(), min_y = min_x, min_z = min_x;
  double max_x = -min_x, max_y = -min_x, max_z = -min_x;

  bool empty() const { return min_x > max_x; }
  void include(const Position& place);
};

/// Takes beads with what is known of their layer. `width` is volume ÷ (length · layer height), in mm.
class BeadSink {
 public:
  virtual ~BeadSink() = default;
  virtual void bead(std::size_t layer, const DepositedLayer& about, const Bead& bead, double width) = 0;
};

class Deposit : public BedSink {
 public:
  struct Takers {
    BeadSink* drawing = nullptr;    ///< of every bead
    Spread* spread = nullptr;       ///< where they are laid
    RasterSink* rasters = nullptr;  ///< of every layer when it is finished
  };

  /// Each of the takers may be missing.
  explicit Deposit(const Takers& takers) : takers_(takers) {}

  void laid(const Bead& bead) override;
  void travelled(const Position& from, const Position& to) override;

  /// The last layer is complete.
  void finish();

  const std::vector<DepositedLayer>& layers() const { return layers_; }
  const Extents& extents() const { return extents_; }  ///< of the beads' centre lines
  double volume() const { return volume_; }            ///< in beads
  double dropped() const { return dropped_; }          ///< volume pushed out while the nozzle stood
  const PerFeeder<double>& by_feeder() const { return by_feeder_; }  ///< volume, of both
  double length() const { return length_; }
  double first_start() const { return first_start_; }  ///< s, when the first bead began
  double last_end() const { return last_end_; }        ///< s

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
  double travel_ = 0;      ///< since the last bead
  double last_width_ = 0;  ///< of the last bead
};

}  // namespace unicursal::sim
