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
// - Per isotropic zone: the squared Wasserstein distance of the chords' directions from a uniform
// distribution, to
//   first order.
//
// Departures from the paper: chords are used instead of single edges, because a zigzag of 30° to either side
// becomes straight when it is smoothed, and nothing straighter exists in a graph of triangles; long chords
// are rewarded; the Wasserstein distance is the quadratic form Σ |m_k|² ÷ 2k² of the Fourier coefficients m_k
// of the directions' distribution, which equals it near evenness, and whose change costs a few additions.
// Waves of more than twelve periods in half a turn are left out, as they hardly count.
//
// The terms of stops and edges are known from their neighbourhood; those of zones, and the length, are sums
// over the whole tour. So the objective has two classes: one holds what is the same for all windows of a tour
// (tour_windows.hpp), the other follows the changes in one window.
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

class WindowObjective;

class CycleObjective {
 public:
  CycleObjective(const EditableTour& tour, const DemandAt& demand, const RunCost& run_cost,
                 const ObjectiveWeights& weights);

  double value() const;  ///< mm · rad², computed from the tour as it is now
  /// Takes over the sums of all windows, which have been followed since the last call.
  void join(const std::vector<WindowObjective>& windows);
  /// Mean edge length of the tour at the start, mm.
  double edge_length() const { return edge_length_; }

 private:
  friend class WindowObjective;
  static constexpr int bins = 100;                           ///< of directions, over half a turn
  static constexpr int waves = 12;                           ///< Fourier coefficients that count
  using Waves = std::array<double, std::size_t{2} * waves>;  ///< a cosine and a sine each, times 1 ÷ (√2 k)
  /// The contribution of a stop.
  struct Share {
    double cost = 0;    ///< of the chord's angle, mm · rad²
    double length = 0;  ///< half the chord, mm
    int bin = -1;       ///< of the chord's direction; −1 outside isotropic zones
  };
  struct EvenZone {
    Waves moments{};    ///< of the chords' directions, mm
    double length = 0;  ///< total length of the chords at the start, mm: the scale of the term
  };

  Share share(StopIndex s, StopIndex before, StopIndex next) const;
  double edge_cost(HalfEdgeIndex h) const { return edge_cost_[PlanarGraph::edge(h)]; }
  double length_cost(double length) const;
  void add_direction(Waves& moments, int bin, double length) const;

  const EditableTour& tour_;
  ObjectiveWeights weights_;
  Per<StopIndex, Demand> demand_;
  Per<EdgeIndex, double> edge_cost_;
  Per<StopIndex, Share> shares_;
  Per<EvenZoneIndex, EvenZone> even_;
  std::array<Waves, bins> waves_of_{};  ///< of a direction in the middle of each bin
  std::size_t stops_ = 1;               ///< that are visited
  double edge_length_ = 0, length_ = 0;
  Per<StopIndex, int>
      flaw_at_;              ///< position of the stop in its window's list of flaws; −1 if it is not a flaw
  double flawed_above_ = 0;  ///< a stop that costs more is a flaw
};

/// The objective as seen from one window. Objects of different windows may be used at the same time. Sums
/// over the whole tour are taken to change everywhere as they do in this window: were each window to correct
/// the whole, all together would correct too much.
class WindowObjective {
 public:
  WindowObjective(CycleObjective& whole, const TourWindow& window);

  /// By how much the change would raise the value, mm · rad². Remembered for accept().
  double difference(const LocalChange& change);
  /// Takes over the last change that was given to difference(). To be called before EditableTour::apply().
  void accept();

  /// Flaws are movable stops that cost notably more than a long chord along the asked direction would.
  const std::vector<StopIndex>& flaws() const { return flaws_; }

 private:
  friend class CycleObjective;
  using Share = CycleObjective::Share;
  using Waves = CycleObjective::Waves;
  /// A stop that gets new neighbours by the change that difference() saw last.
  struct Affected {
    StopIndex stop, before, next;
    Share share;
  };
  /// What that change adds to the moments of a zone.
  struct Turned {
    EvenZoneIndex zone;
    Waves by;
  };

  void note(const LocalChange& change);
  double evenness_difference();
  Waves& turned_in(EvenZoneIndex zone);
  void update_flaw(StopIndex s);

  CycleObjective* whole_;
  double like_this_;                  ///< how many times the window's stops make all stops
  Per<EvenZoneIndex, Waves> gained_;  ///< since the start, mm
  double longer_ = 0;                 ///< since the start, mm
  std::vector<StopIndex> flaws_;
  std::array<Affected, 8> affected_{};
  std::size_t affected_count_ = 0;
  std::array<Turned, 8> turned_{};
  std::size_t turned_count_ = 0;
  double stretched_ = 0;  ///< by the change that difference() saw last, mm
};

}  // namespace unicursal::core
