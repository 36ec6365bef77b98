// The phase of a field over a region. mm, radians.
#pragma once

#include "core/stripes/phase.hpp"
#include "core/stripes/stripe_grid.hpp"

namespace unicursal::core::test {

inline Phase phase_of(const Polygon& region, const DirectionField& field, double w) {
  const BorderIndex border(region, w);
  return find_phase(stripe_grid(region, border, field, w), border, w);
}

}  // namespace unicursal::core::test
