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
#include "core/cycle/tour_windows.hpp"
#include "core/numeric/dice.hpp"

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

/// A tour, its order, and the tables that make the search for operations cheap. At first the whole tour is
/// one window.
class EditableTour {
 public:
  explicit EditableTour(Tour tour);

  const Tour& tour() const { return tour_; }
  Tour release() && { return std::move(tour_); }

  /// Cuts the tour into windows. From then on only movable stops of a window are moved, and changes of
  /// different windows may be looked for and carried out at the same time.
  std::vector<TourWindow> divide(double side, const Vec2& corner);

  /// Looks for a random operation at a random place around a stop. Returns nullopt if none fits there, which
  /// is the usual case. Every possible operation is found with a probability above zero. Takes about 30 ns.
  std::optional<LocalChange> look(StopIndex at, Dice& dice) const;
  /// Looks for the given operation (1 to 4) at the given movable stop.
  std::optional<LocalChange> look(int operation, StopIndex at, Dice& dice) const;

  /// The stop that a half-edge of a change leads to.
  StopIndex target(HalfEdgeIndex h) const { return stop_at(origin(PlanarGraph::twin(h))); }

  /// Whether the stretches of the tour that pass through the window keep their ends. Only then may the change
  /// be carried out.
  bool keeps_ends(const LocalChange& change, const TourWindow& window) const;
  /// Preconditions: the change was found in the window as it is now, and keeps its ends.
  void apply(const LocalChange& change, TourWindow& window);

  /// Whether the order along the tour agrees with the links, and the links of each stop with one another.
  /// Precondition: the tour is not divided.
  bool consistent() const;

 private:
  enum Side { left, right };
  /// A half-edge, with its neighbours in its triangle; these are invalid in other faces.
  struct Corner {
    NodeIndex origin;
    HalfEdgeIndex next, previous;
  };
  /// A stretch of the tour that operation 4 moves as a whole.
  struct Block {
    StopIndex first, last;
  };
  using Blocks = std::array<Block, 4>;
  using Marks = std::array<bool, 4>;

  std::optional<LocalChange> relocate_one(StopIndex x, Dice& dice) const;
  std::optional<LocalChange> swap_two(StopIndex x) const;
  std::optional<LocalChange> relocate_two(StopIndex x) const;
  std::optional<LocalChange> flip_two_rhombuses(StopIndex x, Dice& dice) const;

  NodeIndex origin(HalfEdgeIndex h) const { return corners_[h].origin; }
  StopIndex start(HalfEdgeIndex h) const { return stop_at(origin(h)); }
  HalfEdgeIndex after(HalfEdgeIndex h) const { return corners_[h].next; }
  /// The side after `h` of the triangle on the left or right of it; invalid if that face is not a triangle.
  /// The sides of a triangle on the right are taken clockwise, so that they follow each other there too.
  HalfEdgeIndex step(HalfEdgeIndex h, Side side) const;
  /// Whether the tour runs along this edge, in either direction.
  bool used(HalfEdgeIndex h) const;
  bool movable(StopIndex s) const { return movable_[s] != 0; }
  HalfEdgeIndex leave(StopIndex s) const { return tour_.leave[s]; }
  HalfEdgeIndex random_spoke(StopIndex s, Dice& dice) const;
  /// Two triangles with a common free edge.
  struct Rhombus {
    std::array<HalfEdgeIndex, 4> side{};  ///< counter-clockwise; the first and the third are used
    bool inside = false;                  ///< the tour has it on its left
  };
  std::optional<Rhombus> rhombus_about(HalfEdgeIndex diagonal) const;

  /// The stretches between the links that operation 4 cuts, in their new order.
  Blocks blocks_of(const LocalChange& change) const;
  /// Which of the stretches the tour leaves the window in.
  Marks leaving(const Blocks& blocks, const TourWindow& window) const;
  void relabel(const Blocks& blocks, const Marks& leaving, TourWindow& window);
  void fit(StopIndex first, StopIndex last, TourWindow& window);
  void label_all(TourWindow& window);

  Tour tour_;
  TourOrder order_;
  Per<HalfEdgeIndex, Corner> corners_;
  std::vector<HalfEdgeIndex> spokes_;          ///< all half-edges, sorted by origin
  Per<NodeIndex, std::uint32_t> first_spoke_;  ///< where a node's spokes begin; one more entry at the end
  Per<StopIndex, char> movable_;
  Per<StopIndex, std::int32_t> window_of_;  ///< empty as long as the tour is not divided
};

}  // namespace unicursal::core
