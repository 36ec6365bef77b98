// All mixtures of a print, as the printer will deliver them.
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

class Palette {
 public:
  static constexpr std::size_t steps = 64;  ///< of a gradient: finer than the eye can distinguish

  /// Applies the floor share, the calibration of the feeders, and rounding.
  using Calibrate = std::function<CalibratedMixture(const Mixture&)>;

  Palette(const std::vector<Material>& materials, const Calibrate& calibrate);

  std::size_t size() const { return shades_.size(); }
  /// Of every mixture; 0 if there are no materials.
  std::size_t feeders() const { return shades_.empty() ? 0 : shades_.front().front().delivered.feeders(); }
  bool is_gradient(std::size_t material) const { return steps_of(material) > 1; }
  /// The number of shades of a material; 1 unless it is a gradient.
  std::size_t steps_of(std::size_t material) const { return shades_[material].size(); }
  Shade shade(std::size_t material, double part) const;
  const CalibratedMixture& calibrated(const Shade& shade) const {
    return shade.material < size() ? shades_[shade.material][shade.step] : added_[shade.material - size()];
  }
  /// The mixture that leaves the nozzle.
  const Mixture& mixture(const Shade& shade) const { return calibrated(shade).delivered; }
  /// Adds a mixture that no zone asks for, such as a pulse of an overshoot.
  Shade add(const Mixture& mixture);
  /// The number of mixtures that have been added.
  std::size_t added() const { return added_.size(); }
  /// The target at `part` of a gradient, not rounded to a step.
  Mixture mixture(std::size_t material, double part) const;

 private:
  Calibrate calibrate_;
  std::vector<std::vector<CalibratedMixture>> shades_;
  std::vector<CalibratedMixture> added_;
};

}  // namespace unicursal::gcode
