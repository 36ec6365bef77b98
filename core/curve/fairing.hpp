// Fairing (paper §3.4): moves the vertices of a closed curve until it covers its island evenly, is smooth,
// has the asked length and follows the asked directions. L-BFGS on coverage + length + smoothness + alignment
// (2) over a sampling lattice. γ are the weights of the paper's objectives (core/README.md, "Notation").
//
// Departures from the paper:
// - The curve stays simple and inside by construction: no vertex moves farther than clearance.hpp allows.
// - Length is held by an augmented Lagrangian, since the paper's penalty (31) lets it drift by 10 to 20 %.
// - The line search uses Armijo's condition with resets, since jumps of the gradient, when samples change
// their
//   owners, make a strong-Wolfe search fail.
// - Strands move together (long_waves.hpp), and fingers that crowd a place are drawn back (retraction.hpp).
// - Vertices are spaced out again between rounds, and the last rounds use twice as many, for rounder
// hairpins.
#pragma once

#include <functional>
#include <vector>

#include <cstddef>

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"
#include "core/geometry/polygon.hpp"
#include "core/numeric/parallel.hpp"
#include "core/numeric/step_budget.hpp"

namespace unicursal::core {

/// A zone whose directions are to be spread evenly (`even`, isotropic) or to be all alike (anisotropic).
struct OrientationZone {
  std::function<bool(const Vec2&)> contains;
  bool even = true;
};

struct FairingOptions {
  double target_length = 0;             ///< mm
  bool hold_length = true;              ///< false: coverage alone decides on the length, as thin islands need
  double bead_width = 0;                ///< mm, area ÷ target length: the unit of the weights below
  int coarse_iterations = 34;           ///< on the given curve
  int fine_iterations = 34;             ///< on the subdivided curve
  double coarse_samples_per_width = 5;  ///< lattice squares per bead width, while the curve is coarse
  double samples_per_width = 5;         ///< lattice squares per bead width
  const DirectionField* field = nullptr;  ///< the directions to follow; null if there are none
  // Weight of (33) on the given curve, square bead widths; compare γ_Obj (54).
  double alignment = 0.05;
  // Weight of (33) on the subdivided curve: strands that are aligned stay so, and coverage evens out.
  double fine_alignment = 0.002;
  bool alignment_by_length = false;    ///< (33) along segments instead of over their cells, see alignment.hpp
  bool may_retract = true;             ///< cut off fingers that crowd a place (retraction.hpp)
  std::vector<OrientationZone> zones;  ///< zones with an orientation objective
  double evenness = 1;         ///< weight of (53) in isotropic zones, square bead widths; compare γ_Obj (54)
  double likeness = 0.006;     ///< weight of (53) in anisotropic zones, square bead widths
  MayContinue may_continue;    ///< asked before each iteration
  double smoothness = 0.04;    ///< γ_Lap in units of area ÷ vertices (31)
  Workers* workers = nullptr;  ///< share the work; the result does not depend on them
};

struct FairingResult {
  Curve curve;
  int iterations = 0;
};

/// Five smoothing steps (5), each limited to the vertices' freedom (clearance.hpp). Precondition as for
/// fair().
Curve smoothed(const Curve& curve, const Polygon& island, double bead_width, Workers* workers = nullptr);

/// Precondition: `curve` is simple, strictly inside `island` and has at least 5 vertices. The same holds for
/// the result.
FairingResult fair(const Curve& curve, const Polygon& island, const FairingOptions& options);

}  // namespace unicursal::core
