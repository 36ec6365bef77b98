// The cell graph (paper §3.2): Voronoi edges clipped by the domain, whose border belongs to the graph.
// Every node has exactly three edges: three Voronoi edges inside, two stretches of border and one Voronoi
// edge on the border.
//
// The paper calls the graph bridgeless "by construction". An edge here separates two different cells, or a
// cell from the outside, so there are no bridges; but three cases need care. A cell at a dead end has two
// sides only (parallel edges). A Voronoi cell that a non-convex border cuts in pieces gives one face per
// piece. A hole within one cell would be a loop without nodes: such a cell gets a second seed.
#pragma once

#include <optional>
#include <vector>

#include "core/field/direction_field.hpp"
#include "core/geometry/polygon.hpp"
#include "core/graph/planar_graph.hpp"
#include "core/graph/seeds.hpp"
#include "core/graph/voronoi.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

/// A cubic, bridgeless, connected planar multigraph whose faces are the cells, each a topological disc.
struct CellGraph : PlanarGraph {
  /// What the cells are nearest to; seeds without a direction have no length. From make_cell_graph() only.
  std::vector<Segment> needles;
};

struct GraphOptions {
  /// For needles d ≈ 1.7 bead widths spaces the first cycle right; rows along the mean direction of the
  /// field, direction(field.integral(domain)), and a stretch of 2 help where the field hardly turns.
  SeedOptions seeds;
  /// Where it asks for directions, seeds become needles (needles.hpp); points everywhere when null or empty.
  const DirectionField* field = nullptr;
  /// In lengths of the paper's needles. Twice as long, most end at their cell's border; that aligned the
  /// final curves best (brain: 0.08 rad², with 1 0.19, with points 0.31), and covers no worse.
  double needle_length = 2;
};

/// Nothing when the domain fits into one cell, or when the numbers are too close to degenerate to decide
/// (after several tries with other seeds, the last of them with points only): callers then fall back to a
/// contour. `domain` must be simple.
std::optional<CellGraph> make_cell_graph(const Polygon& domain, const GraphOptions& options, Random& random);
inline std::optional<CellGraph> make_cell_graph(const Polygon& domain, double d, Random& random) {
  return make_cell_graph(domain, GraphOptions{SeedOptions{d, {}, 1}, nullptr, 0}, random);
}

/// One try with given seeds. `untouched_holes` receives the holes that no Voronoi edge reaches.
std::optional<CellGraph> clip_to_domain(const std::vector<Vec2>& seeds, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes);
/// The same with the diagram of the seeds, or of needles.
std::optional<CellGraph> clip_to_domain(const Voronoi& diagram, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes);

}  // namespace unicursal::core
