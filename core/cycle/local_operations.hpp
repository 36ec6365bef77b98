// The four local operations of the paper's Figure 9: small changes that turn one Hamiltonian cycle of the
// refined graph into another. They are drawn in local_operations.cpp.
//
// In every operation some triangles change sides: those inside the tour come to lie outside, and the other
// way round.
// - Operation 1 takes one stop out of the tour and inserts it between two neighbours elsewhere.
// - Operation 2 exchanges two stops that follow each other.
// - Operation 3 takes two stops that follow each other out of the tour and inserts them elsewhere.
// - Operation 4 flips two rhombuses that share a corner, one inside and one outside. The first flip cuts the
//   tour in two, and the second must join the halves. So this operation alone needs the order of the stops
//   along the tour (tour_order.hpp); the other three look only at the triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/cycle/tour.hpp"
#include "core/cycle/tour_order.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

/// A stop and the half-edge by which the tour will leave it.
struct Departure {
  StopIndex stop;
  HalfEdgeIndex by;
};

/// A change of the tour, given by the stops that the tour will leave by another half-edge.
struct LocalChange {
  int operation = 0;                      ///< 1 to 4, as in Figure 9
  std::array<Departure, 4> departures{};  ///< the first `count` are used
  std::size_t count = 0;
};

/// A tour, its order, and the tables that make the search for operations cheap.
class EditableTour {
 public:
  explicit EditableTour(Tour tour);

  const Tour& tour() const { return tour_; }
  Tour release() && { return std::move(tour_); }

  /// Looks for a random operation at a random place around a stop. Returns nullopt if none fits there, which
  /// is the usual case. Every possible operation is found with a probability above zero. Takes about 30 ns.
  std::optional<LocalChange> look(StopIndex at, Random& random) const;
  /// Looks for the given operation (1 to 4) at the given free stop.
  std::optional<LocalChange> look(int operation, StopIndex at, Random& random) const;
  /// Precondition: there is a free stop.
  StopIndex random_stop(Random& random) const { return free_stops_[random.below(free_stops_.size())]; }

  /// The stop that a half-edge of a change leads to.
  StopIndex target(HalfEdgeIndex h) const { return stop_at(tour_.graph.target(h)); }

  /// Precondition: the change was found in the tour as it is now.
  void apply(const LocalChange& change);

  /// How many stops were given a new label in the order so far.
  std::uint64_t labelled() const { return order_.labelled(); }

  /// Whether the order along the tour agrees with the links, and the links of each stop with one another.
  bool consistent() const;

 private:
  enum Side { left, right };

  std::optional<LocalChange> relocate_one(StopIndex x, Random& random) const;
  std::optional<LocalChange> swap_two(StopIndex x) const;
  std::optional<LocalChange> relocate_two(StopIndex x) const;
  std::optional<LocalChange> flip_two_rhombuses(StopIndex x, Random& random) const;

  StopIndex origin(HalfEdgeIndex h) const { return stop_at(tour_.graph.origin(h)); }
  /// The side after `h` of the triangle on the left or right of it; invalid if that face is not a triangle.
  /// The sides of a triangle on the right are taken clockwise, so that they follow each other there too.
  HalfEdgeIndex step(HalfEdgeIndex h, Side side) const;
  /// Whether the tour runs along this edge, in either direction.
  bool used(HalfEdgeIndex h) const;
  bool free(StopIndex s) const { return tour_.free[s] != 0; }
  HalfEdgeIndex leave(StopIndex s) const { return tour_.leave[s]; }
  HalfEdgeIndex random_spoke(StopIndex s, Random& random) const;
  /// Two triangles with a common free edge.
  struct Rhombus {
    std::array<HalfEdgeIndex, 4> side{};  ///< counter-clockwise; the first and the third are used
    bool inside = false;                  ///< the tour has it on its left
  };
  std::optional<Rhombus> rhombus_about(HalfEdgeIndex diagonal) const;

  Tour tour_;
  TourOrder order_;
  Per<HalfEdgeIndex, HalfEdgeIndex> next_, previous_;  ///< within a triangle; invalid in other faces
  std::vector<HalfEdgeIndex> spokes_;                  ///< all half-edges, sorted by origin
  Per<NodeIndex, std::uint32_t> first_spoke_;  ///< where a node's spokes begin; one more entry at the end
  std::vector<StopIndex> free_stops_;
};

}  // namespace unicursal::core
