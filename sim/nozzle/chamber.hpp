// The melt between the feeders and the nozzle's opening, by what comes out of it when something goes in.
//
// Model: the inlets join, the plastic passes a pipe of the dead volume unmixed (plug flow), then a row of
// equal, well-stirred tanks, whose last one is the opening. It is linear in the mixture and keeps every
// feeder's volume: what goes in comes out or is inside. Inflow of one mixture is solved exactly, so the
// result does not depend on how a move is cut into pieces.
//
// `dead_volume` passes before the first trace of a new mixture, `mixing_volume` from there to 95 % of it; so
// one tank holds mixing_volume ÷ the 95 % point of the gamma distribution whose shape is the number of tanks.
//
// Retraction opens a void in the inlets that are drawn back; what is fed next fills it before anything comes
// out. An inlet's own content is one filament and delays nothing. Departure from a real hot end: no pressure,
// no oozing, no flow between inlets. At power-up the chamber is full of equal shares of all feeders.
// mm³.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

struct ChamberSize {
  double dead_volume = 2.1;
  double mixing_volume = 4.0;  ///< 0: no tanks
  std::size_t tanks = 2;       ///< 1 to 8
};

/// Plastic that came out, uniform enough to be one bead.
struct Outflow {
  double from = 0, to = 0;  ///< parts of the feed, 0…1, during which it came out
  PerFeeder<double> volume{};

  double total() const;
};

/// The volume of one tank.
double tank_volume(const ChamberSize& size);

/// What has arrived of a new mixture, 0…1, when `volume` has passed since it was switched to.
double step_response(const ChamberSize& size, double volume);

class Chamber {
 public:
  Chamber(const ChamberSize& size, std::size_t feeders);

  /// Feeds each feeder's volume (negative: draws it back), all at constant rates; gives what came out, in
  /// pieces short enough that the mixture hardly changes within one.
  std::vector<Outflow> feed(const PerFeeder<double>& volume);

  /// What is inside, voids counted as missing.
  PerFeeder<double> content() const;

 private:
  struct Slug {
    double volume = 0;
    PerFeeder<double> shares{};
  };
  using Shares = PerFeeder<double>;

  void push(const Shares& volume, double from, double to, std::vector<Outflow>& out);
  bool settled(const Shares& shares) const;
  void append(const Shares& shares, double volume);
  Shares through_tanks(const Shares& shares, double volume);

  ChamberSize size_;
  double tank_volume_;
  std::deque<Slug> pipe_;      ///< the oldest in front
  std::vector<Shares> tanks_;  ///< shares in each
  Shares voids_{};
};

}  // namespace unicursal::sim
