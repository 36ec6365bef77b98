#include "host/engine/bare_watch.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace unicursal::host {

void BareWatch::look(const PlannedLayer& planned) {
  Found found{planned.layer.index, planned.layer.top, 0, 0, 0};
  double whole = 0;
  for (const core::Island& island : planned.layer.islands) whole += area(island.outline);
  for (const core::Bare& bare : planned.bare) {
    found.area += bare.area;
    found.walls += bare.axis_length;
  }
  found.share = whole > 0 ? found.area / whole : 0;
  area_ += found.area;
  walls_ += found.walls;
  whole_ += whole;
  if (found.share > mostly_bare) mostly_bare_area_ += found.area;
  if (found.share > bare_share_to_warn_of) ++warned_of_;
  if (found.share > worst_.share) worst_ = found;
}

std::string BareWatch::warning() const {
  if (warned_of_ == 0) return "";
  return fmt::format(
      "layer {} (z = {:.2f} mm){} leaves {:.0f} % of its area without plastic: {:.1f} mm²{}; widen what is "
      "too "
      "narrow for a bead, or choose a smaller bead_width",
      worst_.layer + 1, worst_.top,
      warned_of_ > 1 ? fmt::format(", the worst of {} such layers,", warned_of_) : "", 100 * worst_.share,
      worst_.area,
      worst_.walls > 0 ? fmt::format(", and {:.1f} mm of walls that a bead would fit", worst_.walls) : "");
}

std::string BareWatch::fault() const {
  return fmt::format("leaves {:.0f} % of layer {} (z = {:.2f} mm) without plastic", 100 * worst_.share,
                     worst_.layer + 1, worst_.top);
}

nlohmann::json BareWatch::to_json() const {
  return {{"area_mm2", area_},           {"share", whole_ > 0 ? area_ / whole_ : 0.0},
          {"walls_mm", walls_},          {"layers_warned_of", warned_of_},
          {"worst_layer", worst_.layer}, {"worst_share", worst_.share}};
}

}  // namespace unicursal::host
