// Finds how filaments mix from mixtures of them that were printed and measured.
//
// Found are the lift, a strength of each filament and a loss of each two filaments, the last two for red,
// green and blue (Mixing, filaments.hpp). The sum of squares of the differences is made least after Levenberg
// and Marquardt, together with how far each number lies from its usual value. So a number about which the
// mixtures say little stays where it was. A mixture that no numbers explain, such as a spoilt patch, counts
// less the farther away it is (Cauchy's weights).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/lab.hpp"

namespace unicursal::picture {

struct MeasuredMixture {
  std::vector<double> shares;  ///< of the first feeders, sum 1
  Light light{};               ///< as it was seen
  double noise = 1;            ///< how uncertain that is, ΔE
};

struct FittedFilaments {
  Mixing mixing;
  std::vector<Colour> pure;         ///< the filaments alone
  std::vector<double> differences;  ///< of each mixture from the fitted model, ΔE2000
};

enum class PureColours {
  kept,   ///< they are known, and the measurements refer to them
  fitted  ///< they are measured like the mixtures; those given are a first guess
};

/// `pure`: the colour of each filament alone. Returns nullopt if the mixtures are too few or too much alike
/// to say how these filaments mix: each filament has to be a tenth or more of some mixture with another,
/// there have to be two mixtures more than filaments, and they have to differ to the eye.
std::optional<FittedFilaments> fit_filaments(std::span<const Colour> pure,
                                             std::span<const MeasuredMixture> measured, PureColours colours);

}  // namespace unicursal::picture
