// How the light falls on a test print: brighter here, darker there, and in each colour differently. It is
// found from places that are made of the same material, and cancelled.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/picture/lab.hpp"

namespace unicursal::host {

/// What a place of a known material looks like. The materials are numbered from 0; none needs a known colour.
struct KnownPlace {
  core::Vec2 place{0, 0};
  picture::Light light{};
  std::size_t material = 0;
};

class EvenLight {
 public:
  /// In each channel the logarithm of the light is a polynomial of the place, of the third degree if there
  /// are enough places, plus a constant of the material, plus what the known places nearby have in common.
  /// Places that are far off, as in a glare, do not count. `box` holds all places. Preconditions: at least
  /// one place; materials are less than 100.
  EvenLight(const std::vector<KnownPlace>& known, const core::Box& box);

  /// Natural logarithms of how much brighter this place is lit than the middle of the box.
  picture::Light brightness(const core::Vec2& place) const;
  /// The light as it would be in the middle of the box.
  picture::Light evened(const core::Vec2& place, const picture::Light& seen) const;

 private:
  std::vector<double> terms_of(const core::Vec2& place) const;

  core::Box box_;
  std::size_t terms_ = 0;
  std::array<std::vector<double>, 3> polynomials_;
  struct Rest {
    core::Vec2 place{0, 0};
    std::array<double, 3> logarithm{}, weight{};
  };
  std::vector<Rest> rests_;  ///< of the known places, beyond the polynomial
};

}  // namespace unicursal::host
