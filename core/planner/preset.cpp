#include "core/planner/preset.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::core {
namespace {

int scaled(int steps, double quality) {
  return std::max(static_cast<int>(std::lround(steps * quality)), 1);
}

/// Steps on the coarse curve, over a coarser lattice, cost half as much as those on the fine one and do most
/// of the work.
Settings best() {
  Settings s;
  s.fairing.coarse_iterations = 50;
  s.fairing.fine_iterations = 22;
  s.fairing.coarse_samples_per_width = 4;
  return s;
}

Settings paper() {
  Settings s;
  s.shuffle.rule = ShuffleOptions::Rule::algorithm_1;
  s.shuffle.sweeps = 16;  // ShuffleIter + ImproveIter, 8N each
  s.shuffle.champions = 12;
  s.shuffle.candidates = 2;
  s.shuffle.generations = 3;
  s.shuffle.at_flaws = 0;
  s.shuffle.weights = {0, 0, 0, 1};
  s.one_direction_sweeps = 1;
  s.edge_alignment = 1;
  s.stripes = false;
  // (54) with A ÷ L0 = w: 1/50 of a square bead width, for alignment and orientation alike.
  s.fairing.alignment = s.fairing.fine_alignment = 0.02;
  s.fairing.evenness = s.fairing.likeness = 0.02;
  s.fairing.smoothness = 0.3;
  s.fairing.coarse_iterations = 100;
  s.fairing.fine_iterations = 60;
  return s;
}

}  // namespace

Settings settings(Preset preset, double quality) {
  Settings s = preset == Preset::paper ? paper() : best();
  s.shuffle.sweeps = scaled(s.shuffle.sweeps, quality);
  // The curve hardly changes after these iterations; more than twice as many would be wasted.
  s.fairing.coarse_iterations = scaled(s.fairing.coarse_iterations, std::min(quality, 2.0));
  s.stripe_coarse_iterations = scaled(s.stripe_coarse_iterations, std::min(quality, 2.0));
  s.fairing.fine_iterations = scaled(s.fairing.fine_iterations, std::min(quality, 2.0));
  s.stripe_fine_iterations = scaled(s.stripe_fine_iterations, std::min(quality, 2.0));
  return s;
}

}  // namespace unicursal::core
