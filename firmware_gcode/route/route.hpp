// Chooses where every closed curve begins, its direction, and the order of the islands, over the next layers
// together. mm, mm³.
//
// A closed curve ends where it began, so that its start and direction decide everything. They are found by
// dynamic programming along the chain of all paths of the layers at hand. The states of a path are its
// vertices, each in both directions. The cost of a transition between states of two paths is the sum of
// - the length of the way, and a travel if it is longer than 1.5 bead widths: this outweighs all the others;
// - a change of mixture between the end of one path and the beginning of the next;
// - the visibility of the seam.
// A curve that begins on a border between zones has one change less inside. After each optimisation the first
// layer is final and the next layer joins.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "firmware_gcode/print/placed_layer.hpp"

namespace unicursal::gcode {

struct RouteOptions {
  std::size_t horizon = default_horizon;
  /// The horizon grows with the print: the first layer is final as soon as it arrives, the next two as soon
  /// as two are known, and so on. So a hot nozzle waits for the planning of one layer and not of four. This
  /// may cost a travel if the part shrinks to a tower right after its first layer.
  bool growing = false;
  Seam seam = Seam::hidden;
  /// The cost of a change between the mixtures of two zones, mm³ of misplaced plastic; 0 for equal mixtures.
  std::function<double(std::size_t from, std::size_t to)> change_cost;
};

/// One path of a layer with its start and direction.
struct Traversal {
  std::size_t path = 0;
  std::size_t start = 0;  ///< vertex
  bool reversed = false;
};

struct RoutedLayer {
  PlacedLayer layer;
  std::vector<Traversal> traversals;
};

/// Bead k of a traversal, 0 ≤ k < path.size(): its index, and its end point.
std::size_t bead_of(const core::BeadPath& path, const Traversal& leg, std::size_t k);
core::Vec2 bead_end(const core::BeadPath& path, const Traversal& leg, std::size_t k);
/// Returns whether the path has a length to print.
bool is_printable(const core::BeadPath& path);

class Route {
 public:
  explicit Route(RouteOptions options);
  ~Route();
  Route(Route&&) noexcept;

  void add(PlacedLayer layer);
  /// No layer will follow.
  void end();
  /// The layers that were added and not yet taken; valid until the next call.
  std::vector<const PlacedLayer*> waiting() const;
  /// The next layer whose route is final; nullopt if there is none yet.
  std::optional<RoutedLayer> take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
