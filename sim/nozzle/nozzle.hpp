// Turns moves into beads: the place, volume and mixture of the plastic that leaves the nozzle. The chamber
// determines the mixture, so one move can give several beads. Within a move the feed is proportional to the
// distance. mm, mm³, printer seconds.
#pragma once

#include "sim/motion/move.hpp"
#include "sim/nozzle/chamber.hpp"

namespace unicursal::sim {

/// A straight strand on the bed; a drop if it begins and ends at the same place.
struct Bead {
  Position from, to;
  double volume = 0;
  PerFeeder<double> shares{};  ///< Shares of the feeders in the plastic; the sum is 1.
  double start = 0, end = 0;   ///< Times, as if the move had a constant speed.
};

/// Receives beads in the order in which they are laid, and movements without a bead.
class BedSink {
 public:
  virtual ~BedSink() = default;
  virtual void laid(const Bead& bead) = 0;
  /// The nozzle moved in the xy plane without laying anything.
  virtual void travelled(const Position& from, const Position& to) = 0;
};

class Nozzle : public MoveSink {
 public:
  /// `filament_diameter` in mm.
  Nozzle(double filament_diameter, const Chamber& chamber, BedSink& bed);

  void moved(const ExecutedMove& move) override;

  /// Cross-section of the filament, mm².
  double filament_area() const { return filament_area_; }
  const Chamber& chamber() const { return chamber_; }
  /// Volume fed less volume retracted, by feeder.
  const PerFeeder<double>& fed() const { return fed_; }

 private:
  double filament_area_;
  Chamber chamber_;
  BedSink& bed_;
  PerFeeder<double> fed_{};
};

}  // namespace unicursal::sim
