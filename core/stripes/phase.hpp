// The phase of stripes along a field of directions. Strands are to lie where its cosine is zero. mm, radians.
//
// Sources: Knöppel, Crane, Pinkall, Schröder, Stripe Patterns on Surfaces, ACM Transactions on Graphics 34
// (4), 2015, sections 3 and 5: a complex number ψ = e^{iφ} at every node, where φ should grow by n · (q − p)
// π ÷ w from node p to node q, n being the direction across the strands. A direction has no sign: where those
// of two neighbours disagree, one ψ is conjugated. Chermain, Bonneel, Martínez, Lefebvre, Orientable Dense
// Cyclic Infill for Anisotropic Appearance Fabrication, 2023, (6) to (8): one period of φ holds two strands,
// so that the lines cos φ = 0 are closed and two neighbours always run in opposite senses.
//
// Departures: Knöppel et al. take the least eigenvector, whose modulus vanishes at singularities. Here |ψ| is
// set to 1 between solves with one factor of the matrix, and borders that strands run along fix the phase:
// the first strand lies half a bead width inside.
#pragma once

#include <vector>

#include "core/numeric/step_budget.hpp"
#include "core/stripes/stripe_grid.hpp"

namespace unicursal::core {

class Phase {
 public:
  /// One angle per node of the grid.
  Phase(StripeGrid grid, std::vector<double> angles, double bead_width);

  const StripeGrid& grid() const { return grid_; }
  double angle(std::size_t node) const { return angles_[node]; }
  /// cos φ, interpolated; 1 far outside.
  double cosine(const Vec2& point) const;

 private:
  StripeGrid grid_;
  std::vector<double> angles_;
  double per_mm_;  ///< growth of φ across the strands
};

/// The phase whose growth is nearest to what the directions ask for. `may_continue` is asked before each
/// solve.
Phase find_phase(StripeGrid grid, const BorderIndex& border, double bead_width,
                 const MayContinue& may_continue = {});

}  // namespace unicursal::core
