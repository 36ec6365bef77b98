// Needles (paper §3.2, Figure 4): a short segment at every seed, along the directions that a field asks for
// in the seed's cell. Cells become longer in that direction, and many of their edges run along it.
//
// V is the field of asked directions, in doubled angle (core/README.md, "Notation"), and P the domain. A seed
// p has the Voronoi cell C_p, and V_p = ∫ V over C_p (32). The needle's angle is ½∠V_p (4), and its length is
// ‖V_p‖ ÷ area(C_p) · √(area(P) ÷ πS), with S seeds in all. It is centred on p and ends before the border of
// C_p. Where no direction is asked, its length is 0. Seeds move so that ∫ dist² to the needles becomes least
// (11 to 26); the gradient leaves out that a needle turns and grows while its seed moves, as in the paper.
//
// Departures from the paper: integrals over cells are sums over a sampling lattice (the diagram of needles is
// built only once, at the end, see needle_diagram.hpp); needles are updated only in every fifth iteration, so
// that the objective stays the same in between; a needle keeps a tenth of its way to the border of C_p free,
// so that no two needles touch; a factor is applied to the length, which is 1 in the paper. mm, mm², mm⁴.
#pragma once

#include <vector>

#include "core/field/direction_field.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/numeric/quasi_newton.hpp"

namespace unicursal::core {

class NeedleTessellation {
 public:
  /// `d` mm is the distance between seeds; `length` is the factor on the paper's length of needles.
  NeedleTessellation(const Polygon& domain, const DirectionField& field, double d, double length);
  NeedleTessellation(const NeedleTessellation&) = delete;  // owners_ refers to lattice_
  NeedleTessellation& operator=(const NeedleTessellation&) = delete;

  /// The needle of each seed. Precondition: seeds lie inside the domain.
  std::vector<Segment> needles(const std::vector<Vec2>& seeds);

  /// Returns ∫ dist² to the needles, mm⁴, and sets its gradient for moves without turning, mm³ per needle.
  /// The gradient is exact for the lattice as long as samples keep their nearest needle.
  double coverage(const std::vector<Segment>& needles, std::vector<Vec2>& gradient);

  /// Moves the seeds downhill by L-BFGS, with new needles every few iterations. Seeds stay inside the domain.
  void relax(std::vector<Vec2>& seeds, int iterations);

 private:
  /// The state of the descent.
  struct Descent {
    std::vector<Segment> needles;
    double value = 0;
    std::vector<Vec2> gradient;
    QuasiNewton newton;
  };
  bool step(Descent& state);

  double d_, length_;
  Lattice lattice_;
  LatticeOwners owners_;
  BorderIndex border_;
  double area_;
  std::vector<Eigen::Vector2f> asked_;  ///< ∫ V over each sample's piece of the domain, mm²
};

}  // namespace unicursal::core
