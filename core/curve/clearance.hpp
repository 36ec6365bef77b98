// How far vertices may move so that a simple curve inside its island stays simple and inside. mm.
//
// If no vertex moves farther from where it was measured than `freedom[i]`, no two segments without a common
// vertex can meet, and none can meet the border: each segment moves by no more than 0.45 of its distance to
// either. Neighbouring segments cannot fold over each other either, since before that the far end of one
// would have to cross the other, and that end belongs to a segment that is no neighbour.
#pragma once

#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

/// Distances, mm, at which a curve counts as touching. Without them a curve that is pressed against something
/// would halve its distance at every step until rounding puts it across.
struct Margins {
  double border = 0;
  double self = 0;
};

/// Per vertex, at most 0.45 · `reach`. Precondition: at least 5 vertices, curve simple and inside.
std::vector<double> freedom(const Curve& curve, const BorderIndex& border, double reach,
                            const Margins& margins = {}, Workers* workers = nullptr);

/// Pairs of segments without a common vertex that meet, decided with exact signs; 0 for a simple curve.
std::size_t self_intersections(const Curve& curve);

/// Segments that touch or cross the border or lie outside; 0 for a curve wholly inside.
std::size_t segments_outside(const Curve& curve, const BorderIndex& border);

}  // namespace unicursal::core
