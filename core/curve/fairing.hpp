// Fairing (paper §3.4): moves the vertices of a closed curve until it covers its island evenly, is smooth,
// has the length and follows the directions that were asked for. L-BFGS on coverage + length + smoothness +
// alignment (2) over a sampling lattice.
//
// Departures from the paper:
// - The curve stays simple and inside by construction: no vertex moves farther than clearance.hpp allows.
// - Length is held by an augmented Lagrangian, since the paper's penalty (31) lets it drift by 10 to 20 %.
// - Armijo steps with resets: owners of samples change, which a strong-Wolfe search dislikes.
// - Strands move together (long_waves.hpp), and fingers that crowd a place are drawn back (retraction.hpp).
// - Vertices are spread anew between rounds, and the last rounds have twice as many, for rounder hairpins.
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

/// A zone whose directions are to be spread evenly (isotropic) or to be all alike (anisotropic).
struct OrientationZone {
  std::function<bool(const Vec2&)> contains;
  bool even = true;
};

struct FairingOptions {
  double target_length = 0;      ///< mm
  bool hold_length = true;       ///< false: length follows from the price of coverage, as thin islands need
  double bead_width = 0;         ///< mm, area ÷ target length: the unit of every length below
  int coarse_iterations = 40;    ///< on the curve as it comes
  int fine_iterations = 40;      ///< on the subdivided curve
  double samples_per_width = 5;  ///< lattice squares per bead width
  const DirectionField* field = nullptr;  ///< what to align with; nothing when null
  double alignment =
      0.05;  ///< weight of (33) on the curve as it comes, square bead widths; compare γ_Obj (54)
  double fine_alignment =
      0.002;  ///< on the subdivided curve: what is aligned stays so, and coverage evens out
  std::vector<OrientationZone> zones;  ///< of the orientation objectives
  double evenness = 1;         ///< weight of (53) in isotropic zones, square bead widths; compare γ_Obj (54)
  double likeness = 0.006;     ///< the same in anisotropic zones
  MayContinue another;         ///< asked before each iteration
  double smoothness = 0.04;    ///< γ_Lap in units of area ÷ vertices (31)
  Workers* workers = nullptr;  ///< that share the work; the result is the same for any number of them
};

struct FairingResult {
  Curve curve;
  int iterations = 0;
};

/// Five steps of (5), each cut short where it would use up a vertex's freedom. Precondition as for fair().
Curve smoothed(const Curve& curve, const Polygon& island, double bead_width, Workers* workers = nullptr);

/// Precondition: `curve` is simple, strictly inside `island` and has at least 5 vertices. So is the result.
FairingResult fair(const Curve& curve, const Polygon& island, const FairingOptions& options);

}  // namespace unicursal::core
