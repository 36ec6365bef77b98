// Weights and run lengths of the two optimisers, by name.
#pragma once

#include "core/curve/fairing.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core {

struct Settings {
  ShuffleOptions shuffle;
  FairingOptions fairing;       ///< without the fields that depend on the island
  double edge_alignment = 0.1;  ///< weight of the alignment of edges, relative to that of chords
  // First and last temperature where directions are asked for, mean edge lengths · rad²: strands order
  // themselves in between and freeze below.
  double aligned_hot = 0.3, aligned_cold = 0.15;
  int one_direction_sweeps =
      10;               ///< factor on the sweeps of islands with one direction, which take longer to order
  bool stripes = true;  ///< where directions are asked for everywhere, strands are laid along them first
  // Weights of (33) and (53) in the fairing of such strands, square bead widths, as in FairingOptions.
  double stripe_alignment = 0.15, stripe_fine_alignment = 0.058, stripe_likeness = 0.04;
  int stripe_coarse_iterations = 20;  ///< such strands are nearly where they belong from the start
  int stripe_fine_iterations = 34;
};

/// `quality` scales how long the optimisers run; 1 is the default, more is better and slower.
Settings settings(Preset preset, double quality);

}  // namespace unicursal::core
