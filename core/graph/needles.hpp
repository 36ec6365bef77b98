// Needles (paper §3.2, Figure 4): a short segment at every seed, along the directions that a field asks for
// within the seed's cell, so that cells grow long in that direction and many of their edges run along it.
//
// Of the seed p with Voronoi cell C_p, V_p = ∫ V over C_p (32): the needle's angle is ½∠V_p (4), its length
// ‖V_p‖ ÷ area(C_p) · √(area(P) ÷ πS), S the number of seeds; it is centred on p and ends before the border
// of C_p. Where no direction is asked its length is 0. Seeds move to where ∫ dist² to the needles is least
// (11 to 26); a needle's turning and growing while its seed moves is left out of the gradient, as in the
// paper.
//
// Departures from the paper: integrals over cells are sums over a sampling lattice (the diagram of needles is
// built but once, at the end, see needle_diagram.hpp); needles are found anew in every fifth iteration,
// between which the objective is one and the same; a needle keeps a tenth of its way to the border of C_p
// free, so that no two needles touch; a factor on the length, 1 in the paper. mm, mm², mm⁴.
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
  /// `d` mm is the distance between seeds; `length` that of the needles, in lengths of the paper's.
  NeedleTessellation(const Polygon& domain, const DirectionField& field, double d, double length);
  NeedleTessellation(const NeedleTessellation&) = delete;  // the owners know where the lattice is
  NeedleTessellation& operator=(const NeedleTessellation&) = delete;

  /// The needle of every seed. Precondition: seeds lie inside the domain.
  std::vector<Segment> needles(const std::vector<Vec2>& seeds);

  /// ∫ dist² to the needles, mm⁴, and its gradient when needles move without turning, mm³ per needle. Exact
  /// for the lattice as long as samples keep their nearest needle.
  double coverage(const std::vector<Segment>& needles, std::vector<Vec2>& gradient);

  /// Moves the seeds downhill by L-BFGS, with new needles every few iterations. Seeds stay in the domain.
  void relax(std::vector<Vec2>& seeds, int iterations);

 private:
  /// Where the descent stands.
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
  std::vector<Eigen::Vector2f> asked_;  ///< per sample: ∫ V over its piece of the domain, mm²
};

}  // namespace unicursal::core
