// Weights and lengths of runs of the two optimisers, by name.
#pragma once

#include "core/curve/fairing.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core {

struct Settings {
  ShuffleOptions shuffle;
  FairingOptions fairing;       ///< without what depends on the island
  double edge_alignment = 0.1;  ///< weight of the alignment of edges against that of chords
  // Where directions are asked for, strands order themselves at one temperature and freeze below it.
  double aligned_hot = 0.3, aligned_cold = 0.15;
  int one_direction_sweeps = 10;  ///< times as many where there is one direction: order is far to go to
};

/// `quality` scales how long the optimisers run; 1 is the default, more is better and slower.
Settings settings(Preset preset, double quality);

}  // namespace unicursal::core
