#include "firmware_gcode/mixing/palette.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::gcode {
namespace {

Mixture between(const Mixture& a, const Mixture& b, double part) {
  Shares shares = a.shares();
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] += part * (b.share(f) - a.share(f));
  return Mixture(shares);
}

}  // namespace

Palette::Palette(const std::vector<Material>& materials, const Calibrate& calibrate) : calibrate_(calibrate) {
  for (const Material& material : materials) {
    std::vector<CalibratedMixture> shades{calibrate(material.mixture)};
    for (std::size_t step = 1; material.gradient && step <= steps; ++step) {
      const double part = static_cast<double>(step) / static_cast<double>(steps);
      shades.push_back(calibrate(between(material.mixture, material.gradient->to, part)));
    }
    shades_.push_back(std::move(shades));
  }
}

Shade Palette::shade(std::size_t material, double part) const {
  const auto last = static_cast<double>(shades_[material].size() - 1);
  return {material, static_cast<std::size_t>(std::lround(part * last))};
}

Shade Palette::add(const Mixture& mixture) {
  const CalibratedMixture as_fed = calibrate_(mixture);
  const auto known = std::find_if(added_.begin(), added_.end(),
                                  [&](const auto& other) { return other.delivered == as_fed.delivered; });
  const auto index = static_cast<std::size_t>(known - added_.begin());
  if (known == added_.end()) added_.push_back(as_fed);
  return {size() + index, 0};
}

Mixture Palette::mixture(std::size_t material, double part) const {
  const auto& shades = shades_[material];
  return shades.size() == 1 ? shades.front().delivered
                            : between(shades.front().delivered, shades.back().delivered, part);
}

}  // namespace unicursal::gcode
