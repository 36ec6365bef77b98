// How a change of mixture is hurried on: before the new mixture is fed, one or two others are for a little
// while, chosen so that what leaves the tanks comes to the new one sooner and by a better way. Where the
// mixtures leave room, that is more of what is to come than is wanted in the end (and before it, of what
// goes); between two that have a third half-way between them it is a way round that one. mm³.
//
// Method: the answer of tanks is linear, so that what comes out of a sequence of inflows is a sum of shifted
// step responses. The pulses' mixtures and volumes are found by a pattern search from a coarse grid; the
// measure is that of the schedule (misplaced plastic, and once more what is taken for another material). No
// nozzle is quite what its profile says, so that the mean over nozzles like it is what counts: of 15 %
// less and 15 % more volume, and of other numbers of tanks. Source: input shaping of linear systems
// (control engineering); the paper has nothing of the kind.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

/// Fed one after the other, and then the new mixture.
struct Overshoot {
  struct Pulse {
    Shade shade;
    double volume = 0;
  };
  std::vector<Pulse> pulses;
  double lead = 0;  ///< what the tanks let through from the first pulse to the border that the change is for
};

struct OvershootOptions {
  ChamberModel chamber;
  double before_border = 0.5;  ///< the share of every change that falls before its border
  double floor_share = 0.02;   ///< the least of every feeder
  /// Every pulse takes a virtual tool: there are none where more mixtures than this would come of it, nor
  /// beside gradients, which take all tools.
  std::size_t most_mixtures = 15;
};

/// The overshoots of a print by change; empty unless found by with_overshoots().
class Overshoots {
 public:
  void add(std::size_t from, std::size_t to, Overshoot overshoot);

  /// Null where the change is best left alone.
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
