// The four local operations of the paper's Figure 9: small changes that turn one Hamiltonian cycle of the
// refined graph into another.
//
// In every operation some triangles change sides: those inside the tour come to lie outside, and the other
// way round. Operation 1 takes a node out of its place and puts it between two neighbours elsewhere,
// operation 2 lets two nodes that follow each other change places, operation 3 moves two that follow each
// other together. Operation 4 flips two rhombuses with a common corner, one inside, one outside: the first
// flip cuts the tour in two, the second must join the halves. Only that needs to know the order along the
// tour (tour_order.hpp); the other three look at the triangles alone.
#pragma once

#include <array>
#include <optional>

#include "core/cycle/tour.hpp"
#include "core/cycle/tour_order.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

/// Where a stop's half-edge will lead instead.
struct Departure {
  StopIndex stop = -1;
  HalfEdgeIndex by = -1;
};

struct LocalChange {
  int operation = 0;                      ///< 1 to 4, as in Figure 9
  std::array<Departure, 4> departures{};  ///< the stops that are left by another half-edge
  int count = 0;                          ///< how many of them
};

/// A tour, its order, and the tables that make looking for operations cheap.
class EditableTour {
 public:
  explicit EditableTour(Tour tour);

  const Tour& tour() const { return tour_; }
  Tour release() && { return std::move(tour_); }

  /// One look at a random place around a stop: the change that could be made there, nothing when the place
  /// does not match. Every operation is found somewhere with a probability above zero. Some 30 ns.
  std::optional<LocalChange> look(StopIndex at, Random& random) const;
  /// One look for a given operation (1 to 4) at a given free stop.
  std::optional<LocalChange> look(int operation, StopIndex at, Random& random) const;
  /// Precondition: there is a free stop.
  StopIndex random_stop(Random& random) const { return free_stops_[random.below(free_stops_.size())]; }

  /// The stop that a half-edge of a change leads to.
  StopIndex target(HalfEdgeIndex h) const { return tour_.graph.target(h); }

  /// Precondition: the change was found in the tour as it is now.
  void apply(const LocalChange& change);

  /// How many stops were given a new place in the order so far.
  std::uint64_t labelled() const { return order_.labelled(); }

  /// The order along the tour agrees with the links, and each stop's links agree with each other.
  bool consistent() const;

 private:
  std::optional<LocalChange> relocate_one(StopIndex x, Random& random) const;
  std::optional<LocalChange> swap_two(StopIndex x) const;
  std::optional<LocalChange> relocate_two(StopIndex x) const;
  std::optional<LocalChange> flip_two_rhombuses(StopIndex x, Random& random) const;

  /// The side after `h` of the triangle on side 0 (left) or 1 (right) of it; −1 when that face is none.
  /// On the right side half-edges are turned so that they follow each other there too.
  HalfEdgeIndex step(HalfEdgeIndex h, int side) const;
  bool used(HalfEdgeIndex h) const;
  bool free(StopIndex s) const { return tour_.free[static_cast<std::size_t>(s)] != 0; }
  HalfEdgeIndex leave(StopIndex s) const { return tour_.leave[static_cast<std::size_t>(s)]; }
  HalfEdgeIndex random_spoke(StopIndex s, Random& random) const;
  /// Four sides, counter-clockwise, of the rhombus about a free edge, the first one used.
  struct Rhombus {
    std::array<HalfEdgeIndex, 4> side{};
    bool inside = false;  ///< the tour has it on its left
  };
  std::optional<Rhombus> rhombus_about(HalfEdgeIndex diagonal) const;

  Tour tour_;
  TourOrder order_;
  std::vector<HalfEdgeIndex> next_, previous_;  ///< in a triangle; −1 in other faces
  std::vector<HalfEdgeIndex> spokes_;           ///< half-edges by origin
  std::vector<std::uint32_t> first_spoke_;      ///< per node, and the end
  std::vector<StopIndex> free_stops_;
};

}  // namespace unicursal::core
