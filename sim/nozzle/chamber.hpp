// The melt between the feeders and the nozzle's opening (sim/README.md, Physics): tanks in series.
//
// Model: the inlets join; the plastic passes a pipe of the dead volume unmixed (plug flow), then equal,
// perfectly stirred tanks in series. The model is linear in the mixture and keeps every feeder's volume: what
// goes in comes out or is inside. A constant inflow is solved exactly, so the result does not depend on how a
// move is cut into pieces.
//
// `dead_volume` passes before the first trace of a new mixture, `mixing_volume` from there to 95 % of it. One
// tank therefore holds mixing_volume ÷ the 95 % quantile of the gamma distribution whose shape is the number
// of tanks.
//
// A retraction opens a void in the inlets that are drawn back; the next feed fills it before anything comes
// out. An inlet holds one filament only, so it adds no delay. Departures from a real hot end: no pressure, no
// oozing, no flow between inlets. At power-up the chamber is full of equal shares of all feeders. mm³.
//
// firmware_gcode/mixing/chamber.hpp has the same model for planning. The two share no code on purpose: the
// simulator is independent of the program that it checks.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

struct ChamberSize {
  double dead_volume = 2.1;
  double mixing_volume = 4.0;  ///< 0 = no tanks.
  std::size_t tanks = 2;       ///< 1 to 8.
};

/// Plastic that has left the nozzle, uniform enough to be one bead.
struct Outflow {
  double from = 0, to = 0;  ///< Part of the feed during which it came out, 0…1.
  PerFeeder<double> volume{};

  double total() const;
};

/// The volume of one tank.
double tank_volume(const ChamberSize& size);

/// The share of a new mixture in the outflow, 0…1, when `volume` has passed since the switch.
double step_response(const ChamberSize& size, double volume);

class Chamber {
 public:
  Chamber(const ChamberSize& size, std::size_t feeders);

  /// Feeds each feeder's volume (negative = retracts it), all at constant rates. Returns the outflow, in
  /// pieces so short that the mixture hardly changes within one.
  std::vector<Outflow> feed(const PerFeeder<double>& volume);

  /// The volume inside by feeder, less the voids.
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
  std::size_t feeders_;
  std::deque<Slug> pipe_;      ///< The oldest slug is in front.
  std::vector<Shares> tanks_;  ///< Shares in each tank.
  Shares voids_{};
};

}  // namespace unicursal::sim
