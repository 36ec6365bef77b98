// Between the feeders and the bed: what leaves the nozzle, where and of which mixture. Moves come in, beads
// go out; one move may give several beads, since what leaves need not be what is fed at that moment. This
// nozzle has no chamber: what leaves is what is fed. mm, mm³, printer seconds.
#pragma once

#include "sim/motion/move.hpp"

namespace unicursal::sim {

/// A straight strand laid on the bed.
struct Bead {
  Position from, to;
  double volume = 0;
  PerFeeder<double> shares{};  ///< of the feeders in the plastic that arrived; they add up to 1
  double start = 0, end = 0;
};

/// Takes beads in the order in which they are laid, and moves that lay nothing.
class BedSink {
 public:
  virtual ~BedSink() = default;
  virtual void laid(const Bead& bead) = 0;
  /// The nozzle went from one place to another in the plane without laying anything.
  virtual void travelled(const Position& from, const Position& to) = 0;
};

class Nozzle : public MoveSink {
 public:
  /// `filament_diameter` in mm.
  Nozzle(double filament_diameter, BedSink& bed);

  void moved(const ExecutedMove& move) override;

  /// mm² of filament.
  double filament_area() const { return filament_area_; }

 private:
  double filament_area_;
  BedSink& bed_;
};

}  // namespace unicursal::sim
