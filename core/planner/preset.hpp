// Weights and lengths of runs of the two optimisers, by name.
#pragma once

#include "core/curve/fairing.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/planner/plan_island.hpp"

namespace unicursal::core {

struct Settings {
  ShuffleOptions shuffle;
  FairingOptions fairing;       ///< without what depends on the island
  double edge_alignment = 0.1;  ///< weight of the alignment of edges against that of chords
};

/// `quality` scales how long the optimisers run; 1 is the default, more is better and slower.
Settings settings(Preset preset, double quality);

}  // namespace unicursal::core
