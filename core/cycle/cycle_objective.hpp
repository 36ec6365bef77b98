// What the combinatorial optimiser looks at (paper §3.3.3, (1)), updated change by change. Smaller is better.
//
// Per stop: half the chord from the stop before to the stop after stands for the curve there, as in the point
// terms of (33). A long chord is good everywhere, since what the tour folds up is lost when the curve is
// smoothed; a chord off the asked direction costs as the square of the angle. Per edge: alignment over a
// rectangle about the edge, and crossings of material borders (55), both known beforehand. Per isotropic
// zone: a histogram of 100 bins of the chords' directions and its squared Wasserstein distance from an even
// one, to first order.
//
// Departures from the paper: chords, not edges alone, because a zigzag of 30° to either side is straight once
// it is smooth, and in a graph of triangles it is the straightest there is; the reward for long chords; the
// Wasserstein distance as the quadratic form Σ |m_k|² ÷ 2k² of the histogram's Fourier coefficients, which
// equals it near evenness and whose change costs a few additions.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/cycle/local_operations.hpp"
#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// What a place asks of the curve.
struct Demand {
  Vec2 direction{0, 0};  ///< V of the direction (4), ‖V‖ ≤ 1; zero where none is asked
  int even_zone = -1;    ///< number of the isotropic zone, −1 outside of such
};
using DemandAt = std::function<Demand(const Vec2&)>;

struct ObjectiveWeights {
  double chord = 1;     ///< alignment of chords
  double reward = 0.3;  ///< rad²: what a chord earns per length; at this squared angle it earns nothing
  double length =
      0;  ///< mm: as all chords together come near it, more length earns less, then costs; 0: never
  double evenness = 2;  ///< of E_iso · L in isotropic zones
};

class CycleObjective {
 public:
  CycleObjective(const EditableTour& tour, const DemandAt& demand, const RunCost& run_cost,
                 const ObjectiveWeights& weights);

  double value() const { return value_; }  ///< mm · rad²
  /// By how much the change would raise the value. Remembered for accept().
  double difference(const LocalChange& change);
  /// Takes over the change that difference() saw last; call it before EditableTour::apply().
  void accept();
  /// The value from scratch, to hold value() against.
  double recomputed() const;

  /// Free stops that cost notably more than a long chord along the asked direction would.
  const std::vector<StopIndex>& flaws() const { return flaws_; }
  /// mm, of the tour at the start, in the mean.
  double edge_length() const { return edge_length_; }

 private:
  static constexpr int bins = 100;
  using Histogram = std::array<double, bins>;
  struct Piece {        ///< a stop's share
    double cost = 0;    ///< of the angle, mm · rad²
    double length = 0;  ///< half the chord, mm
    int bin = -1;       ///< of the histogram; −1 outside isotropic zones
  };
  struct EvenZone {
    Histogram mass{}, potential{};  ///< mm per bin, and its convolution with the kernel
    double length = 0;              ///< mm, at the start: the scale of the term
  };

  Piece piece(StopIndex s, StopIndex before, StopIndex next) const;
  double edge_cost(HalfEdgeIndex h) const { return edge_cost_[static_cast<std::size_t>(h / 2)]; }
  double evenness_of(const EvenZone& zone) const;
  double length_cost(double length) const;
  void update_flaw(StopIndex s);
  void add_mass(int zone, int bin, double weight);
  double evenness_difference() const;

  const EditableTour& tour_;
  ObjectiveWeights weights_;
  std::vector<Demand> demand_;     ///< per stop
  std::vector<double> edge_cost_;  ///< per edge
  std::vector<Piece> pieces_;      ///< per stop
  std::vector<EvenZone> even_;
  Histogram kernel_{};
  double value_ = 0, edge_length_ = 0, length_ = 0;
  std::vector<StopIndex> flaws_;
  std::vector<int> flaw_at_;  ///< per stop: where it stands in flaws_, −1 if it does not
  double flawed_above_ = 0;   ///< cost of a stop

  struct Affected {
    StopIndex stop, before, next;
    Piece piece;
  };
  std::array<Affected, 8> affected_{};
  int affected_count_ = 0;
  double difference_ = 0, longer_ = 0;
};

}  // namespace unicursal::core
