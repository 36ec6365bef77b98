// What the zones of a part are made of: single mixtures and gradients between two.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// The way from one mixture to another across a zone: from it up to `begin`, to the other from `end` on,
/// evenly between. Places are measured along `along`, on the bed, mm.
struct Gradient {
  Mixture to;
  std::array<double, 3> along{1, 0, 0};  ///< of length 1
  double begin = 0, end = 1;             ///< begin < end

  /// 0…1
  double part_at(const core::Vec2& place, double z) const;
};

/// A mixture with the name that the job gives it.
struct Material {
  std::string name;
  Mixture mixture;                        ///< as asked by the job; of a gradient, where it begins
  std::optional<Gradient> gradient = {};  ///< absent: of one mixture
  bool transition = false;                ///< its zones are there to take up the changes between others
};

/// One of the mixtures of a material: of a gradient, that many steps along. Behind the last material come the
/// mixtures that no zone wants.
struct Shade {
  std::size_t material = 0;
  std::size_t step = 0;

  friend bool operator==(const Shade&, const Shade&) = default;
};

}  // namespace unicursal::gcode
