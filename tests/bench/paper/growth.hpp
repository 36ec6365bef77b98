// A closed curve that grows in the island until it fills it, after Pedersen and Singh, "Organic Labyrinths
// and Mazes", 2006 (the paper's [PS06]), written plainly for the comparison. mm.
//
// Per iteration each vertex moves by the sum of
//   - Brownian motion: a random offset, `brownian` spacings on average;
//   - fairing: a share of the way to where its bend is the mean of its neighbours' bends;
//   - attraction and repulsion: (σ/r)^12 − (σ/r)^6 from the nearest point of each other stretch of the curve
//     nearer than `reach`, and away from the border nearer than half a spacing;
// and the curve is resampled, so that its edges stay between a lower and an upper bound. The growth begins as
// a circle in the widest place, with a spacing of many bead widths that is halved whenever the curve has
// filled what it can reach, as in the paper's Figure 26a, where it was done by hand.
//
// The growth ends once all but `bare_share` of the island is nearer than 0.75 bead widths to the curve, once
// nothing has improved for `patience` iterations, or once `most_moves` vertices have moved in all. The curve
// then evens out for `relaxation` iterations, in which edges hardly push.
//
// Simplifications against the original: each edge also pushes its ends apart, which grows faster than
// Brownian motion alone; fairing evens bends out instead of flattening them, which would undo that; and a
// vertex moves at most as far as keeps the curve simple and inside (core/curve/clearance.hpp), where theirs
// bounds the step. All of this favours the growth.
#pragma once

#include <cstdint>

#include "tests/bench/paper/method.hpp"

namespace unicursal::bench {

struct GrowthOptions {
  double brownian = 0.02;      ///< spacings
  double fairing = 0.2;        ///< share of the way to an even bend
  double repulsion = 0.15;     ///< weight of attraction and repulsion, spacings
  double attraction = 0.3;     ///< of attraction relative to repulsion: a whole one would hold the front back
  double stretch = 0.15;       ///< by how much an edge wants to be longer, as a share of its length
  double reach = 1.6;          ///< of attraction and repulsion, spacings
  double coarsest = 8;         ///< first spacing, bead widths
  double bare_share = 0.005;   ///< of the island's area, at the end
  std::size_t patience = 300;  ///< iterations
  std::size_t relaxation = 100;
  std::uint64_t most_moves = 12'000'000;
  std::uint64_t seed = 1;
};

Filling growth(const core::Polygon& island, double bead_width, const GrowthOptions& options = {});

}  // namespace unicursal::bench
