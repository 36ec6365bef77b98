// The paper's series: spacing and time against the seed distance d (Figures 13, 16), objectives (Figure 14),
// smoothing (Figure 15), and how cycles are joined (Table 1). mm, s.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "tests/bench/paper/figures.hpp"

namespace unicursal::bench {

/// Thirty shapes of about 36 mm, the same in every run.
std::vector<core::Polygon> shapes(std::size_t count);

/// Figure 13: the spacing that follows from d if the curve keeps the length of the smoothed cycle, as the
/// paper's does. Of the means of the shapes.
struct SpacingAgainstD {
  double d = 0;
  double mean = 0, least = 0, most = 0;  ///< area ÷ length, mm
};
SpacingAgainstD spacing_at(double d, const std::vector<core::Polygon>& shapes);

/// The spacing of whole plans, which hold the length, against the bead width that is asked for.
struct HeldSpacing {
  double least = 0, most = 0;  ///< bead widths
  double worst_variation = 0;  ///< CV
  std::size_t failed = 0;      ///< shapes without a curve
};
HeldSpacing held_spacing(double bead_width, const std::vector<core::Polygon>& shapes);

/// Figure 16: one call of the paper's Shuffle (Algorithm 1), one step of fairing, and the graph with its
/// first cycle.
struct CostAtD {
  double d = 0;
  std::size_t nodes = 0;
  double graph = 0, shuffle = 0, fairing_step = 0;  ///< processor time
  int fairing_steps = 0;
};
CostAtD cost_at(double d, const core::Polygon& shape);

/// The exponent p of time ∝ nodes^p, by least squares over the logarithms.
double exponent(const std::vector<CostAtD>& costs, double CostAtD::*time);

/// Table 1: how the first cycles of a part become one, with the graph's refinement and without.
struct Joining {
  std::size_t reconnected = 0, doubled = 0;              ///< with refinement
  std::size_t plain_reconnected = 0, plain_doubled = 0;  ///< without
};
Joining joining_of(const Part& part);

/// The doubled edges' share of all joins.
double doubled_share(std::size_t reconnected, std::size_t doubled);

/// Figure 15: the same cycle faired with and without the smoothing term.
struct Smoothing {
  Run with, without;
  double sharpest_with = 0, sharpest_without = 0;  ///< 99th percentile of turns at a vertex, rad
};
Smoothing smoothing_of(const Part& part);

}  // namespace unicursal::bench
