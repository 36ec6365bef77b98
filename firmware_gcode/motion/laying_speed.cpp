#include "firmware_gcode/motion/laying_speed.hpp"

#include <algorithm>

#include "firmware_gcode/motion/held_flow.hpp"
#include "firmware_gcode/motion/speeds.hpp"

namespace unicursal::gcode {

LayingSpeed::LayingSpeed(const Printer& printer, const PrintSettings& settings)
    : printer_(printer),
      settings_(settings),
      flow_(settings.flow),
      layer_flow_(settings.flow),
      automatic_(settings.automatic_flow && !settings.speed),
      open_(automatic_) {}

void LayingSpeed::settle(const std::vector<PlacedLayer>& layers) {
  flow_ = printer_.max_flow;
  for (const PlacedLayer& layer : layers) flow_ = flow_of(layer);
  layer_flow_ = flow_;
  open_ = false;
}

double LayingSpeed::flow_of(const PlacedLayer& layer) const {
  if (!automatic_ || share_held({layer}, settings_, printer_, flow_) >= held_share) return flow_;
  return std::min(flow_, held_flow({layer}, settings_, printer_));
}

double LayingSpeed::speed(const core::Vec2& displacement, double volume, std::size_t layer,
                          double layer_height) const {
  return bead_speed({displacement, volume, layer, layer_height}, layer_flow_, settings_, printer_);
}

}  // namespace unicursal::gcode
