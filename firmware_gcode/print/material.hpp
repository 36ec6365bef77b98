// The materials of a part's zones: single mixtures, and gradients between two mixtures.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// A linear gradient across a zone, from the material's mixture to another. Positions are measured on the bed
/// along the direction `along`, mm. The first mixture lies before `begin`, the other behind `end`.
struct Gradient {
  Mixture to;
  std::array<double, 3> along{1, 0, 0};  ///< unit vector
  double begin = 0, end = 1;             ///< begin < end

  /// The fraction of the way from the first mixture to the other, 0…1.
  double part_at(const core::Vec2& place, double z) const;
};

/// A mixture with the name that the job gives it.
struct Material {
  std::string name;
  Mixture mixture;                        ///< as the job gives it; for a gradient, the first one
  std::optional<Gradient> gradient = {};  ///< absent for a single mixture
  bool transition = false;                ///< its zones take up the changes between other materials
};

/// Identifies one mixture of a print: a material, and the step along its gradient (0 for a single mixture).
/// Indices behind the last material identify the mixtures that a palette has added for overshoots.
struct Shade {
  std::size_t material = 0;
  std::size_t step = 0;

  friend bool operator==(const Shade&, const Shade&) = default;
};

}  // namespace unicursal::gcode
