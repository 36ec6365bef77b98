#include "core/cycle/tour_windows.hpp"

#include <cmath>

namespace unicursal::core {
namespace {

/// The stops that have a stop of another window within two edges.
Per<StopIndex, char> near_others(const Tour& tour, const Per<StopIndex, std::int32_t>& window_of) {
  const RefinedGraph& graph = tour.graph;
  Per<StopIndex, char> next_to(tour.stop_count(), 0), near(tour.stop_count(), 0);
  for (const EdgeIndex e : graph.edges()) {
    const StopIndex a = stop_at(graph.origin(PlanarGraph::forward(e))),
                    b = stop_at(graph.target(PlanarGraph::forward(e)));
    if (window_of[a] != window_of[b]) next_to[a] = next_to[b] = 1;
  }
  near = next_to;
  for (const EdgeIndex e : graph.edges()) {
    const StopIndex a = stop_at(graph.origin(PlanarGraph::forward(e))),
                    b = stop_at(graph.target(PlanarGraph::forward(e)));
    if (next_to[a]) near[b] = 1;
    if (next_to[b]) near[a] = 1;
  }
  return near;
}

}  // namespace

TourWindow whole_window(const Tour& tour) {
  TourWindow window;
  window.sequence = tour.sequence();
  for (const StopIndex s : tour.free.indices()) {
    if (tour.free[s]) window.movable.push_back(s);
  }
  return window;
}

TourWindows cut_into_windows(const Tour& tour, double side, const Vec2& corner) {
  const RefinedGraph& graph = tour.graph;
  const Box box = bounds(graph.position.values());
  const Vec2 low = ((box.min - corner) / side).array().floor(),
             high = ((box.max - corner) / side).array().floor();
  const auto columns = static_cast<std::int32_t>(high.x() - low.x()) + 1,
             rows = static_cast<std::int32_t>(high.y() - low.y()) + 1;
  TourWindows cut;
  cut.window_of.assign(tour.stop_count(), -1);
  for (const NodeIndex n : graph.position.indices()) {
    const Vec2 square = ((graph.position[n] - corner) / side).array().floor();
    cut.window_of[stop_at(n)] = static_cast<std::int32_t>(square.y() - low.y()) * columns +
                                static_cast<std::int32_t>(square.x() - low.x());
  }
  // The second visits to doubled nodes.
  for (StopIndex s(graph.node_count()); s.number() < tour.stop_count(); ++s)
    cut.window_of[s] = cut.window_of[stop_at(graph.origin(tour.leave[s]))];

  const Per<StopIndex, char> near = near_others(tour, cut.window_of);
  cut.windows.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto window = [&](StopIndex s) -> TourWindow& {
    return cut.windows[static_cast<std::size_t>(cut.window_of[s])];
  };
  for (const StopIndex s : tour.free.indices()) {
    if (tour.free[s] && !near[s]) window(s).movable.push_back(s);
  }
  for (const StopIndex s : tour.sequence()) {
    TourWindow& here = window(s);
    here.sequence.push_back(s);
    if (cut.window_of[tour.before[s]] != cut.window_of[s]) here.entries.push_back(s);
  }
  std::erase_if(cut.windows, [](const TourWindow& w) { return w.movable.empty(); });
  return cut;
}

}  // namespace unicursal::core
