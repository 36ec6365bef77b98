// The part as it grows: every bead, summed up by layer, and the beads themselves passed on to be drawn.
// Memory holds one short record for each layer and no bead. A new layer begins whenever a bead ends at
// another height than the one before; its height is the way up from the layer before, or, after a way down,
// from the nearest earlier layer below it (from the bed when there is none). mm, mm³.
#pragma once

#include <limits>
#include <vector>

#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

struct DepositedLayer {
  double z = 0, height = 0;
  std::uint64_t beads = 0;
  double length = 0;  ///< of beads
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
  virtual void bead(std::size_t layer, const Bead& bead, double width) = 0;
};

class Deposit : public BedSink {
 public:
  /// `drawing` may be null.
  explicit Deposit(BeadSink* drawing) : drawing_(drawing) {}

  void laid(const Bead& bead) override;
  void travelled(const Position& from, const Position& to) override;

  const std::vector<DepositedLayer>& layers() const { return layers_; }
  const Extents& extents() const { return extents_; }  ///< of the beads' centre lines
  double volume() const { return volume_; }
  double length() const { return length_; }
  double first_start() const { return first_start_; }  ///< s, when the first bead began
  double last_end() const { return last_end_; }        ///< s

 private:
  void begin_layer(double z);
  void settle_travel(DepositedLayer& layer);

  BeadSink* drawing_;
  std::vector<DepositedLayer> layers_;
  Extents extents_;
  double volume_ = 0, length_ = 0;
  double first_start_ = 0, last_end_ = 0;
  double travel_ = 0;      ///< since the last bead
  double last_width_ = 0;  ///< of the last bead
};

}  // namespace unicursal::sim
