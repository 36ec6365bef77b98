// How far vertices may move so that a simple curve inside its island stays simple and inside. mm.
//
// If no vertex i moves farther than freedom()[i] from where it was measured, no two segments without a common
// vertex can meet, and no segment can meet the border: each segment moves by at most 0.45 of its distance to
// other segments and to the border. Neighbouring segments cannot fold over each other either: the far end of
// one would have to cross the other first, and that end belongs to a segment that is not a neighbour.
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

/// Distances at which a curve counts as touching, mm. Without them a curve that is pressed against the border
/// or against itself would halve its distance at every step until rounding puts it across.
struct Margins {
  double border = 0;
  double self = 0;
};

/// How far each vertex may move, at most 0.45 · `reach`. Precondition: the curve is simple, inside, and has
/// at least 5 vertices.
std::vector<double> freedom(const Curve& curve, const BorderIndex& border, double reach,
                            const Margins& margins = {}, Workers* workers = nullptr);

/// The number of pairs of segments without a common vertex that meet, by exact predicates; 0 for a simple
/// curve.
std::size_t self_intersections(const Curve& curve);

/// The number of segments that touch or cross the border or lie outside; 0 for a curve wholly inside.
std::size_t segments_outside(const Curve& curve, const BorderIndex& border);

}  // namespace unicursal::core
