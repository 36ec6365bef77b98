// Overshoots speed changes of mixture up: before the new mixture, the feeders deliver one or two other
// mixtures (pulses) for a short volume. The pulses are chosen so that the outflow reaches the new mixture
// sooner and by a better way. If the mixtures leave room, a pulse goes beyond the new mixture (and one before
// it beyond the old mixture). If a third material lies half-way between the two, the pulses lead around it.
// mm³.
//
// Method: the tanks respond linearly, so that the outflow of a sequence of inflows is a sum of shifted step
// responses. A pattern search from a coarse grid finds the pulses' mixtures and volumes. The cost is that of
// the schedule: misplaced plastic plus plastic that is nearer to another material. No nozzle matches its
// profile exactly, so that the mean cost over three nozzles counts: the profile's, one with 15 % less volume
// and a tank less, one with 15 % more and a tank more. Source: input shaping of linear systems (control
// engineering); the paper has no counterpart.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

/// The pulses are fed one after the other; the new mixture follows.
struct Overshoot {
  struct Pulse {
    Shade shade;
    double volume = 0;
  };
  std::vector<Pulse> pulses;
  double lead = 0;  ///< volume that leaves the tanks between the first pulse and the border of the change
};

struct OvershootOptions {
  ChamberModel chamber;
  double before_border = 0.5;  ///< fraction of each change that lies before its border
  double floor_share = 0.02;   ///< least share of each feeder
  /// Every pulse needs a virtual tool. There are no overshoots if they would need more mixtures than this, or
  /// if there are gradients, which use all tools.
  std::size_t most_mixtures = 15;
};

/// The overshoots of a print by change; empty unless found by with_overshoots().
class Overshoots {
 public:
  void add(std::size_t from, std::size_t to, Overshoot overshoot);

  /// Returns null if an overshoot does not improve the change.
  const Overshoot* between(std::size_t from, std::size_t to) const;

 private:
  std::map<std::pair<std::size_t, std::size_t>, Overshoot> known_;
};

struct PaletteWithOvershoots {
  Palette palette;  ///< with the mixtures of all pulses
  Overshoots overshoots;
};

/// Finds the overshoots for all changes between two materials that gain by one, and adds the mixtures of
/// their pulses to the palette.
PaletteWithOvershoots with_overshoots(Palette palette, const OvershootOptions& options);

}  // namespace unicursal::gcode
