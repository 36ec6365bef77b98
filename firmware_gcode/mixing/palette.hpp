// The mixtures of all materials of a print, as the printer will really mix them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/print/material.hpp"
#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::gcode {

/// The mixtures of all materials as the printer will really mix them.
class Palette {
 public:
  static constexpr std::size_t steps = 64;  ///< of a gradient: finer than the eye tells apart

  /// What the printer makes of a mixture: floor share, calibration of the feeders, rounding.
  using Calibrate = std::function<CalibratedMixture(const Mixture&)>;

  Palette(const std::vector<Material>& materials, const Calibrate& calibrate);

  std::size_t size() const { return shades_.size(); }
  bool is_gradient(std::size_t material) const { return steps_of(material) > 1; }
  /// How many shades a material has; 1 unless it is a gradient.
  std::size_t steps_of(std::size_t material) const { return shades_[material].size(); }
  Shade shade(std::size_t material, double part) const;
  const CalibratedMixture& calibrated(const Shade& shade) const {
    return shade.material < size() ? shades_[shade.material][shade.step] : added_[shade.material - size()];
  }
  /// As it leaves the nozzle.
  const Mixture& mixture(const Shade& shade) const { return calibrated(shade).delivered; }
  /// A mixture that no zone wants, but that is fed on the way from one to another.
  Shade add(const Mixture& mixture);
  /// How many have been added.
  std::size_t added() const { return added_.size(); }
  /// Between the steps, too: what is wanted, not what is sent.
  Mixture mixture(std::size_t material, double part) const;

 private:
  Calibrate calibrate_;
  std::vector<std::vector<CalibratedMixture>> shades_;
  std::vector<CalibratedMixture> added_;
};

}  // namespace unicursal::gcode
