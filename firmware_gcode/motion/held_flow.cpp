#include "firmware_gcode/motion/held_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware_gcode/motion/speeds.hpp"
#include "firmware_gcode/motion/time_estimate.hpp"

namespace unicursal::gcode {
namespace {

/// That are looked at, of every path its part; more would tell the same.
constexpr std::size_t most_beads = 20000;
constexpr int halvings = 12;          ///< of the range of flows, which leaves steps of 0.2 %
constexpr double least_part = 0.005;  ///< of max_flow: less is not tried
constexpr double flow_steps = 100;    ///< of which 1 mm³/s is told
/// Part of the flow that is kept of the tolerance for what is not reckoned: moves of a few tenths of a mm end
/// on whole motor steps. Without it 89 % of the seconds held where 95 % should have (folds 0.45 mm apart).
constexpr double reserve = 0.005;
constexpr double least_hold = 1 - flow_tolerance + reserve;
constexpr std::size_t regular_layer = 1;  ///< any but the first, which may be slower

/// What the melt feels: the mean over each second.
class Seconds {
 public:
  void add(double taken, double asked) {
    taken_ += taken, asked_ += asked;
    if (taken_ < 1) return;
    all_ += taken_;
    if (asked_ >= least_hold * taken_) held_ += taken_;
    taken_ = asked_ = 0;
  }
  double share() const {
    if (all_ == 0) return asked_ >= least_hold * taken_ ? 1 : 0;  // a print of less than a second
    return held_ / all_;
  }

 private:
  double taken_ = 0, asked_ = 0, held_ = 0, all_ = 0;
};

void lay(const core::BeadPath& path, std::size_t count, const PrintSettings& settings, const Printer& printer,
         TimeEstimate& estimate) {
  const double filament = std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
  for (std::size_t i = 0; i < count; ++i) {
    const core::Vec2 step = path.end(i) - path.start(i);
    if (step.squaredNorm() == 0) continue;
    const double volume = path.beads[i].area * settings.layer_height;
    const double speed =
        bead_speed({step, volume, regular_layer, settings.layer_height}, settings.flow, settings, printer);
    estimate.move({step.x(), step.y(), 0, volume / filament}, speed, step.norm() / speed);
  }
  estimate.stop();
}

}  // namespace

double share_held(const std::vector<PlacedLayer>& layers, PrintSettings settings, const Printer& printer,
                  double flow) {
  settings.automatic_flow = false;
  settings.speed.reset();
  settings.flow = flow;
  Seconds seconds;
  TimeEstimate estimate(printer, [&](double taken, double asked) { seconds.add(taken, asked); });
  std::size_t beads = 0;
  for (const PlacedLayer& layer : layers) {
    for (const core::BeadPath& path : layer.paths) beads += path.size();
  }
  const double part = std::min(1.0, static_cast<double>(most_beads) / static_cast<double>(beads + 1));
  for (const PlacedLayer& layer : layers) {
    for (const core::BeadPath& path : layer.paths) {
      const auto count = static_cast<std::size_t>(std::ceil(part * static_cast<double>(path.size())));
      lay(path, count, settings, printer, estimate);
    }
  }
  return seconds.share();
}

double held_flow(const std::vector<PlacedLayer>& layers, const PrintSettings& settings,
                 const Printer& printer) {
  const auto held = [&](double flow) { return share_held(layers, settings, printer, flow) >= held_share; };
  if (held(printer.max_flow)) return printer.max_flow;
  double low = printer.max_flow * least_part, high = printer.max_flow;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(low * high);
    (held(middle) ? low : high) = middle;
  }
  return std::max(std::floor(low * flow_steps), 1.0) / flow_steps;
}

}  // namespace unicursal::gcode
