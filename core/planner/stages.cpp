#include "core/planner/stages.hpp"

#include "core/field/direction_field.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/stripes/stripe_curve.hpp"

namespace unicursal::core {
namespace {

constexpr double least_asked = 0.15;  ///< a smaller ‖V‖ asks for no direction

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
  stages.nodes = graph.position.values();
  for (const EdgeIndex e : graph.edges()) stages.edges.push_back(graph.line(PlanarGraph::forward(e)));
  for (const Segment& needle : graph.needles) stages.needles.push_back({needle.a, needle.b});
  return stages;
}

CycleStages drawn(const StripeCurve& stripes) {
  CycleStages stages;
  for (const Curve& loop : stripes.loops) {
    stages.edges.push_back(loop.vertices);
    stages.edges.back().push_back(loop.vertices.front());
  }
  stages.first = stages.optimised = stripes.curve.vertices;
  return stages;
}

}  // namespace unicursal::core
