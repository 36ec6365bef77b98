// The colours that were seen all along the bead of a strip, and where its mixture was switched. mm, mm³.
#pragma once

#include <cstddef>

#include "core/numeric/vec2.hpp"
#include "host/tune/colour_answer.hpp"

namespace unicursal::host {

/// A place of the bead.
struct CurvePoint {
  double passed = 0;  ///< volume since the strip's switch; negative before it
  Seen colour{};
  double fat = 0;    ///< how wide the bead is, from the thin reference lines (0) to the fat ones (1)
  double trust = 1;  ///< 0: of no use
  /// Natural logarithms of how much brighter this place is lit than the reference lines. The colour has been
  /// evened; but cameras bend light colours less than dark ones, so that something remains.
  Seen brightness{};
  /// The straight piece of the bead that it lies on. The bed below each may shine through differently.
  std::size_t lane = 0;
  core::Vec2 place{0, 0};
};

/// The feeders change what they feed.
struct MixtureSwitch {
  double passed = 0;  ///< volume since the strip's switch
  double step = 1;    ///< share of the change
};

}  // namespace unicursal::host
