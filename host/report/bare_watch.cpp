#include "host/report/bare_watch.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/planner/bare.hpp"

namespace unicursal::host {

double BareWatch::look(const PlannedLayer& planned) {
  last_ = {planned.layer.index, planned.layer.top, 0, 0, 0};
  double whole = 0;
  for (std::size_t i = 0; i < planned.layer.islands.size(); ++i) {
    const core::Polygon& outline = planned.layer.islands[i].outline;
    whole += area(outline);
    const core::Bare bare = core::look_for_bare(planned.plans[i], outline, bead_width_, least_width_);
    last_.area += bare.area;
    last_.walls += bare.axis_length;
  }
  last_.share = whole > 0 ? last_.area / whole : 0;
  area_ += last_.area;
  walls_ += last_.walls;
  whole_ += whole;
  if (last_.share > bare_share_to_warn_of) ++warned_of_;
  if (last_.share > worst_.share) worst_ = last_;
  return last_.share;
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
  return fmt::format("leaves {:.0f} % of layer {} (z = {:.2f} mm) without plastic", 100 * last_.share,
                     last_.layer + 1, last_.top);
}

nlohmann::json BareWatch::to_json() const {
  return {{"area_mm2", area_},           {"share", whole_ > 0 ? area_ / whole_ : 0.0},
          {"walls_mm", walls_},          {"layers_warned_of", warned_of_},
          {"worst_layer", worst_.layer}, {"worst_share", worst_.share}};
}

}  // namespace unicursal::host
