// The cell graph (paper §3.2): Voronoi edges clipped by the domain, whose border belongs to the graph. Every
// node has exactly three edges: three Voronoi edges inside; two stretches of border and one Voronoi edge on
// the border. d is the distance between neighbouring seeds, V the field of asked directions (core/README.md,
// "Notation").
//
// The paper calls the graph bridgeless "by construction". Here each edge separates two different cells, or a
// cell from the outside, so there are no bridges; but three cases need care. A cell at a dead end has only
// two sides (parallel edges). A Voronoi cell that a non-convex border cuts into pieces gives one face per
// piece. The border of a hole that lies within one cell would be a loop without nodes: such a cell gets a
// second seed.
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
  /// The needle of each cell; a point for a seed without a direction. Only set by make_cell_graph().
  std::vector<Segment> needles;
};

struct GraphOptions {
  /// For needles d ≈ 1.7 bead widths gives the first cycle the right spacing. Where the field hardly turns,
  /// rows along its mean direction, direction(field.integral(domain)), and a stretch of 2 help.
  SeedOptions seeds;
  /// Where it asks for directions, seeds become needles (needles.hpp). If null or empty, all seeds are
  /// points.
  const DirectionField* field = nullptr;
  /// In lengths of the paper's needles. At 2 most needles end at their cell's border; that aligned the final
  /// curves best, with the same coverage (tests/bench/needles measures the graph).
  double needle_length = 2;
};

/// Returns nullopt if the domain fits into one cell, or if the input is nearly degenerate (after several
/// tries with other seeds, the last ones with points only); callers then use a contour. Precondition:
/// `domain` is simple.
std::optional<CellGraph> make_cell_graph(const Polygon& domain, const GraphOptions& options, Random& random);
inline std::optional<CellGraph> make_cell_graph(const Polygon& domain, double d, Random& random) {
  return make_cell_graph(domain, GraphOptions{SeedOptions{d, {}, 1}, nullptr, 0}, random);
}

/// One try with the given seeds. `untouched_holes` receives the holes that no Voronoi edge reaches.
std::optional<CellGraph> clip_to_domain(const std::vector<Vec2>& seeds, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes);
/// One try with the given diagram, of seeds or of needles.
std::optional<CellGraph> clip_to_domain(const Voronoi& diagram, const Polygon& domain,
                                        std::vector<std::size_t>& untouched_holes);

}  // namespace unicursal::core
