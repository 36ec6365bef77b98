// Between the feeders and the bed: what leaves the nozzle, where and of which mixture. Moves come in, beads
// go out; what leaves is what the chamber gives, so one move may give several beads. Within a move the feed
// goes with the way. mm, mm³, printer seconds.
#pragma once

#include "sim/motion/move.hpp"
#include "sim/nozzle/chamber.hpp"

namespace unicursal::sim {

/// A straight strand laid on the bed; a drop where it begins and ends at one place.
struct Bead {
  Position from, to;
  double volume = 0;
  PerFeeder<double> shares{};  ///< of the feeders in the plastic that arrived; they add up to 1
  double start = 0, end = 0;   ///< within a move at even speed
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
  Nozzle(double filament_diameter, const Chamber& chamber, BedSink& bed);

  void moved(const ExecutedMove& move) override;

  /// mm² of filament.
  double filament_area() const { return filament_area_; }
  const Chamber& chamber() const { return chamber_; }
  /// All that was fed, less what was drawn back.
  const PerFeeder<double>& fed() const { return fed_; }

 private:
  double filament_area_;
  Chamber chamber_;
  BedSink& bed_;
  PerFeeder<double> fed_{};
};

}  // namespace unicursal::sim
