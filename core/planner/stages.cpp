#include "core/planner/stages.hpp"

#include "core/field/direction_field.hpp"
#include "core/graph/cell_graph.hpp"

namespace unicursal::core {
namespace {

constexpr double least_asked = 0.15;  ///< ‖V‖ below which a place asks for no direction

}  // namespace

std::vector<AskedDirection> asked_directions(const DirectionField& field, const Polygon& polygon,
                                             double step) {
  std::vector<AskedDirection> directions;
  const Box box = bounds(polygon);
  for (double x = box.min.x() + step / 2; x < box.max.x(); x += step) {
    for (double y = box.min.y() + step / 2; y < box.max.y(); y += step) {
      AskedDirection here{{x, y}, {}};
      if (!contains(polygon, here.point)) continue;
      const Vec2 asked = field.empty() ? Vec2(0, 0) : field.at(here.point);
      if (asked.norm() >= least_asked) here.angle = direction(asked);
      directions.push_back(here);
    }
  }
  return directions;
}

CycleStages drawn(const CellGraph& graph) {
  CycleStages stages;
  stages.nodes = graph.position;
  for (std::size_t e = 0; e < graph.edge_count(); ++e) {
    const auto half = static_cast<HalfEdgeIndex>(2 * e);
    Polyline line{graph.position[static_cast<std::size_t>(graph.origin(half))]};
    graph.append_bends(half, line);
    line.push_back(graph.position[static_cast<std::size_t>(graph.target(half))]);
    stages.edges.push_back(std::move(line));
  }
  for (const Segment& needle : graph.needles) stages.needles.push_back({needle.a, needle.b});
  return stages;
}

}  // namespace unicursal::core
