// The objective of the combinatorial optimiser (paper §3.3.3, (1)), which is updated change by change.
// Smaller is better. V is the field of asked directions, in doubled angle (core/README.md, "Notation").
//
// Terms:
// - Per stop: half the chord from the stop before to the stop after stands for the curve there, as in the
// point
//   terms of (33). A long chord is rewarded everywhere, since anything that is folded up is lost when the
//   curve is smoothed. A chord off the asked direction costs as the square of the angle.
// - Per edge: alignment over a rectangle about the edge, and crossings of material borders (55). Both are
// known
//   beforehand.
// - Per isotropic zone: a histogram of the chords' directions and its squared Wasserstein distance from a
// uniform
//   one, to first order.
//
// Departures from the paper: chords are used instead of single edges, because a zigzag of 30° to either side
// becomes straight when it is smoothed, and nothing straighter exists in a graph of triangles; long chords
// are rewarded; the Wasserstein distance is the quadratic form Σ |m_k|² ÷ 2k² of the histogram's Fourier
// coefficients m_k, which equals it near evenness, and whose change costs a few additions.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/cycle/local_operations.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

using EvenZoneIndex = Index<struct EvenZoneTag>;  ///< an isotropic zone

/// What the part asks of the curve at one point.
struct Demand {
  Vec2 direction{0, 0};     ///< V (4), ‖V‖ ≤ 1; zero where no direction is asked
  EvenZoneIndex even_zone;  ///< the isotropic zone; invalid outside of such zones
};
using DemandAt = std::function<Demand(const Vec2&)>;

struct ObjectiveWeights {
  double chord = 1;  ///< weight of the alignment of chords
  double reward =
      0.3;  ///< reward per length of chord, rad²; a chord whose squared angle equals it earns nothing
  double length = 0;  ///< target total length of the chords, mm: the reward tapers off near it and turns into
                      ///< a penalty beyond; 0 = no target
  double evenness = 2;  ///< weight of E_iso · L in isotropic zones
};

class CycleObjective {
 public:
  CycleObjective(const EditableTour& tour, const DemandAt& demand, const RunCost& run_cost,
                 const ObjectiveWeights& weights);

  double value() const { return value_; }  ///< mm · rad²
  /// By how much the change would raise the value. Remembered for accept().
  double difference(const LocalChange& change);
  /// Takes over the last change that was given to difference(). To be called before EditableTour::apply().
  void accept();
  /// The value computed from scratch, to be compared with value().
  double recomputed() const;

  /// Flaws are free stops that cost notably more than a long chord along the asked direction would.
  const std::vector<StopIndex>& flaws() const { return flaws_; }
  /// Mean edge length of the tour at the start, mm.
  double edge_length() const { return edge_length_; }

 private:
  static constexpr int bins = 100;  ///< of the histogram of directions, over half a turn
  using Histogram = std::array<double, bins>;
  /// The contribution of a stop.
  struct Share {
    double cost = 0;    ///< of the chord's angle, mm · rad²
    double length = 0;  ///< half the chord, mm
    int bin = -1;       ///< of the chord's direction; −1 outside isotropic zones
  };
  struct EvenZone {
    Histogram mass{};       ///< length of chords per bin, mm
    Histogram potential{};  ///< the masses convolved with kernel_
    double length = 0;      ///< total length of the chords at the start, mm: the scale of the term
  };

  Share share(StopIndex s, StopIndex before, StopIndex next) const;
  double edge_cost(HalfEdgeIndex h) const { return edge_cost_[PlanarGraph::edge(h)]; }
  double evenness_of(const EvenZone& zone) const;
  double length_cost(double length) const;
  void update_flaw(StopIndex s);
  void add_mass(EvenZoneIndex zone, int bin, double weight);
  double evenness_difference() const;

  const EditableTour& tour_;
  ObjectiveWeights weights_;
  Per<StopIndex, Demand> demand_;
  Per<EdgeIndex, double> edge_cost_;
  Per<StopIndex, Share> shares_;
  Per<EvenZoneIndex, EvenZone> even_;
  Histogram kernel_{};  ///< Σ_k cos(2kθ) ÷ 2k² for a difference of θ between two directions
  double value_ = 0, edge_length_ = 0, length_ = 0;
  std::vector<StopIndex> flaws_;
  Per<StopIndex, int> flaw_at_;  ///< position of the stop in flaws_; −1 if it is not a flaw
  double flawed_above_ = 0;      ///< a stop that costs more is a flaw

  /// A stop that gets new neighbours by the change that difference() saw last.
  struct Affected {
    StopIndex stop, before, next;
    Share share;
  };
  std::array<Affected, 8> affected_{};
  std::size_t affected_count_ = 0;
  double difference_ = 0, longer_ = 0;
};

}  // namespace unicursal::core
