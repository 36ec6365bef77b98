// Where every cycle begins, which way round it runs, and in what order the islands come: chosen over the next
// layers together. mm, mm³.
//
// A cycle ends where it began, so that all depends on that one place and the direction. They are found by
// dynamic programming along the chain of all paths of the layers at hand: the states of a path are its
// vertices, each in both directions; from one path to the next a state costs
//   a travel, if the next does not begin within 1.5 bead widths, which outweighs everything else; and its
//   length; a change of mixture between the end of the one and the beginning of the other; but a cycle that
//   begins on a border between zones has one change less inside; what the seam would show.
// Then the first layer is taken as decided and the next one joins.
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
  /// The first layer is decided as soon as it comes, the two after it on sight of two, and so on up to the
  /// horizon: a hot nozzle waits for one layer to be planned, not for four. A part that shrinks to a tower
  /// after its very first layer may cost a travel by that.
  bool growing = false;
  Seam seam = Seam::hidden;
  /// What a change between the mixtures of two zones costs, mm³ of plastic in the wrong place; 0 for the
  /// same.
  std::function<double(std::size_t from, std::size_t to)> change_cost;
};

/// One path of a layer, all the way round.
struct Traversal {
  std::size_t path = 0;
  std::size_t start = 0;  ///< vertex
  bool reversed = false;
};

struct RoutedLayer {
  PlacedLayer layer;
  std::vector<Traversal> traversals;
};

/// Bead k of a leg, 0 ≤ k < path.size(): its index and its end.
std::size_t bead_of(const core::BeadPath& path, const Traversal& leg, std::size_t k);
core::Vec2 bead_end(const core::BeadPath& path, const Traversal& leg, std::size_t k);
/// Whether there is anything to print.
bool is_printable(const core::BeadPath& path);

class Route {
 public:
  explicit Route(RouteOptions options);
  ~Route();
  Route(Route&&) noexcept;

  void add(PlacedLayer layer);
  /// No layer will follow.
  void end();
  /// What has been added and not yet taken; valid until the next call.
  std::vector<const PlacedLayer*> waiting() const;
  /// The next layer that is decided, if there is one.
  std::optional<RoutedLayer> take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
