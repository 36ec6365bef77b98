// Prints whole jobs on a simulated machine, in two encodings of the same curves:
//   bench_laying [--speed MM/S] [--acceleration MM/S²] [--layers N] [--preset paper] [--quality Q] JOB.toml …
//
// "own area": each segment gets the plastic of its own area, and the feeders turn at a constant rate (paper
// §4.2). "constant": each segment gets the mean bead width of its layers, so the nozzle runs at a constant
// speed (the comparison in the paper's Figure 21). Curves, volume and deposit model are the same.
//
// --speed sets the flow that would give this mean speed on a machine without inertia; by default the job's
// flow is used. The firmware is driven directly and its queue is always full, so no link affects the result.
// Gaps are reported for the whole layer, and for the part that lies more than a bead width inside the border,
// since no bead width can fill gaps at the border. The more even a curve is (see the deviation of its
// widths), the less the own areas can improve; --quality 0.1 gives a hasty curve. The material balance is
// printed, too: what the motors fed, what lies on the bed, and what is left in the nozzle.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/region.hpp"
#include "host/job/load_job.hpp"
#include "host/report/motion_findings.hpp"
#include "host/report/target.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/firmware/repetier.hpp"
#include "sim/motion/motion_log.hpp"
#include "sim/motion/move_sinks.hpp"

namespace {

using namespace unicursal;

constexpr double raster_pixel = 0.05;  // mm
constexpr double border_tolerance = 0.01;

struct Options {
  std::optional<double> speed, acceleration;
  std::size_t layers = static_cast<std::size_t>(-1);
  core::Preset preset = core::Preset::best;
  double quality = 1;
};

struct Curves {
  std::vector<host::PlannedLayer> layers;
  double length = 0, area = 0, height = 0;  ///< mm, mm², mm
  double area_squares = 0;                  ///< ∫ width² along the curves, mm³

  double width() const { return area / length; }
  /// Standard deviation ÷ mean of the width along the curves.
  double width_variation() const {
    return std::sqrt(std::max(0.0, area_squares / length / (width() * width()) - 1));
  }
};

struct Laying {
  double speed = 0;                  ///< mm/s, mean of all layers but the first, which holds the prime line
  double instants = 0, seconds = 0;  ///< shares of instants and of seconds in which the flow is within 5 %
  double slow = 0;                   ///< mm³/s; 5 % of the seconds have a lower flow
  double fed = 0, left = 0;          ///< mm³; fed by the motors; growth of what is in the chamber
  double laid = 0, dropped = 0, rastered = 0;  ///< mm³; in beads, beside them, and in the rasters
  host::DepositFindings whole, inner;
};

Curves plan(const host::PreparedJob& job, const Options& wanted) {
  host::LookaheadOptions options = host::lookahead_options(job);
  options.count = std::min(options.count, wanted.layers);
  options.plan.preset = wanted.preset;
  options.plan.quality = wanted.quality;
  host::Lookahead lookahead(*job.part, options);
  Curves curves;
  while (auto layer = lookahead.wait()) {
    for (const core::IslandPlan& island : layer->plans) {
      for (const core::PlannedCurve& curve : island.curves) {
        curves.length += curve.path.total_length();
        curves.area += curve.path.total_area();
        for (std::size_t i = 0; i < curve.path.size(); ++i)
          curves.area_squares += curve.path.beads[i].area * curve.path.width(i);
      }
    }
    curves.height = layer->layer.height;
    curves.layers.push_back(std::move(*layer));
  }
  return curves;
}

/// Measures each finished layer, with and without its rim.
class Judges : public sim::RasterSink {
 public:
  Judges(const host::PreparedJob& job, const Curves& curves, std::vector<host::IntendedMaterial> materials,
         Laying& laying)
      : job_(job), curves_(curves), materials_(std::move(materials)), laying_(laying) {}

  void layer(const sim::LayerRaster& raster) override {
    laying_.rastered += volume_of(raster);
    for (const host::PlannedLayer& planned : curves_.layers) {
      host::TargetLayer target = host::target_of(job_, planned, host::placed(job_, planned));
      if (std::abs(target.top - raster.frame().z) > target.height / 4) continue;
      laying_.whole += judged(target, raster);
      core::Region all;
      for (const auto& zone : target.zones) all = core::unite(all, {zone.polygon});
      target.zones.clear();
      for (const auto& polygon : core::offset(all, -curves_.width(), border_tolerance)) {
        target.zones.push_back({polygon, 0});
      }
      if (!target.zones.empty()) laying_.inner += judged(target, raster);
    }
  }

 private:
  static double volume_of(const sim::LayerRaster& raster) {
    const sim::RasterFrame frame = raster.frame();
    std::vector<sim::RasterPixel> pixels(frame.columns);
    double fill = 0;
    for (std::uint64_t row = 0; row < frame.rows; ++row) {
      raster.read_row(row, pixels);
      for (const sim::RasterPixel& pixel : pixels) fill += pixel.fill;
    }
    return fill * frame.pixel_area() * frame.height;
  }

  host::DepositFindings judged(const host::TargetLayer& target, const sim::LayerRaster& raster) const {
    std::uint64_t row = 0;
    const auto rows = [&](std::span<sim::RasterPixel> pixels) { raster.read_row(row++, pixels); };
    return host::judge(target, raster.frame(), rows, materials_, false).findings;
  }

  const host::PreparedJob& job_;
  const Curves& curves_;
  std::vector<host::IntendedMaterial> materials_;
  Laying& laying_;
};

double share_near(const std::map<double, double>& seconds_by_flow, double nominal) {
  double near = 0, all = 0;
  for (const auto& [flow, seconds] : seconds_by_flow) {
    all += seconds;
    if (std::abs(flow / nominal - 1) <= host::MotionFindings::tolerance) near += seconds;
  }
  return all > 0 ? near / all : 0;
}

/// Returns the flow below which the nozzle runs for this share of the time.
double slowest_of(const std::map<double, double>& seconds_by_flow, double share) {
  double left = 0;
  for (const auto& [flow, seconds] : seconds_by_flow) left += share * seconds;
  for (const auto& [flow, seconds] : seconds_by_flow) {
    if ((left -= seconds) < 0) return flow;
  }
  return 0;
}

sim::Machine machine_of(const gcode::Printer& printer, std::optional<double> acceleration) {
  sim::Machine machine;
  machine.bed = printer.bed;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    machine.limits.max_speed[axis] = printer.max_speed[axis];
    machine.limits.max_acceleration[axis] =
        axis < 2 ? acceleration.value_or(printer.max_acceleration[axis]) : printer.max_acceleration[axis];
  }
  return machine;
}

void send(sim::Firmware& firmware, const gcode::Chunk& chunk) {
  for (const std::string& line : chunk.lines) {
    if (!gcode::is_command(line)) continue;
    firmware.receive(line + "\n");
    while (firmware.blocked()) firmware.advance(*firmware.next_event());
  }
}

double sum(const sim::PerFeeder<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

Laying lay(const host::PreparedJob& job, const Curves& curves, const Options& options) {
  gcode::PrintSettings settings = host::print_settings(job);
  gcode::Encoder encoder(job.job.profile.printer, settings);

  Laying laying;
  const gcode::Printer& printer = job.job.profile.printer;
  Judges judges(job, curves, host::intended_materials(job, encoder), laying);
  sim::Spread spread({printer.bed[0], printer.bed[1]}, raster_pixel, printer.feeders);
  sim::Deposit deposit({nullptr, &spread, &judges});
  sim::Nozzle nozzle(printer.filament_diameter, sim::Chamber({printer.dead_volume, printer.mixing_volume}, 3),
                     deposit);
  sim::MotionLog log(nozzle.filament_area());
  sim::MoveSinks sinks({&nozzle, &log});
  const double before = sum(nozzle.chamber().content());
  const auto firmware = sim::make_firmware(machine_of(printer, options.acceleration),
                                           sim::personality("marlin"), sinks, [](std::string_view) {});
  send(*firmware, encoder.start());
  for (const host::PlannedLayer& layer : curves.layers)
    send(*firmware, encoder.layer(host::placed(job, layer)));
  send(*firmware, encoder.rest());
  send(*firmware, encoder.finish());
  firmware->run_down();
  deposit.finish();

  laying.fed = sum(nozzle.fed());
  laying.left = sum(nozzle.chamber().content()) - before;
  laying.laid = deposit.volume();
  laying.dropped = deposit.dropped();

  double length = 0, seconds = 0;
  for (std::size_t i = deposit.layers().size() > 1 ? 1 : 0; i < deposit.layers().size(); ++i) {
    length += deposit.layers()[i].length;
    seconds += deposit.layers()[i].seconds;
  }
  laying.speed = length / seconds;
  laying.instants = share_near(log.flows(), settings.flow);
  laying.seconds = share_near(log.second_flows(), settings.flow);
  laying.slow = slowest_of(log.second_flows(), 1 - host::MotionFindings::hold_share);
  return laying;
}

void print(const char* encoding, const Laying& l) {
  fmt::print(
      "  {:10} {:6.2f} mm/s; flow within 5 % in {:.1f} % of the seconds ({:.1f} % of the instants), above "
      "{:.2f} in 95 %\n",
      encoding, l.speed, 100 * l.seconds, 100 * l.instants, l.slow);
  fmt::print(
      "             gaps {:.2f} mm² ({:.3f} %), inside {:.2f} mm² ({:.3f} %); overfill {:.3f} %, "
      "height deviation {:.3f}\n",
      l.whole.gaps, 100 * l.whole.gap_fraction(), l.inner.gaps, 100 * l.inner.gap_fraction(),
      100 * l.whole.overfill_fraction(), l.whole.fill_deviation());
  fmt::print(
      "             fed {:.3f} mm³ = {:.3f} in beads + {:.3f} beside + {:.3f} in the nozzle, off by {:.0e}; "
      "the "
      "rasters hold {:.3f} of the beads, off by {:.0e}\n",
      l.fed, l.laid, l.dropped, l.left, std::abs(l.laid + l.dropped + l.left - l.fed) / l.fed, l.rastered,
      std::abs(l.rastered - l.laid) / l.laid);
}

void measure(const char* file, const Options& options) {
  host::PreparedJob job = host::prepare(host::load_job(file));
  const Curves curves = plan(job, options);
  if (curves.length == 0) throw std::runtime_error(std::string(file) + ": no curve to lay");
  if (options.speed) job.job.print.flow = *options.speed * curves.width() * curves.height;
  const double nominal = job.job.print.flow / (curves.width() * curves.height);
  fmt::print(
      "\n{}: {} layers, {:.0f} mm of bead {:.3f} mm apart (deviation {:.1f} %), {:.2f} mm³/s, nominally "
      "{:.2f} "
      "mm/s\n",
      file, curves.layers.size(), curves.length, curves.width(), 100 * curves.width_variation(),
      job.job.print.flow, nominal);
  const Laying own = lay(job, curves, options);
  print("own area", own);
  job.job.line_width = curves.width();
  const Laying constant = lay(job, curves, options);
  print("constant", constant);
  fmt::print("  gaps of own areas ÷ of constant width: {:.2f}, inside {:.2f}\n",
             own.whole.gaps / constant.whole.gaps, own.inner.gaps / constant.inner.gaps);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    for (int i = 1; i < argc; ++i) {
      const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0 && i + 1 < argc; };
      if (is("--speed")) {
        options.speed = std::strtod(argv[++i], nullptr);
      } else if (is("--acceleration")) {
        options.acceleration = std::strtod(argv[++i], nullptr);
      } else if (is("--layers")) {
        options.layers = std::strtoull(argv[++i], nullptr, 10);
      } else if (is("--preset")) {
        options.preset = std::strcmp(argv[++i], "paper") == 0 ? core::Preset::paper : core::Preset::best;
      } else if (is("--quality")) {
        options.quality = std::strtod(argv[++i], nullptr);
      } else {
        measure(argv[i], options);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_laying: {}\n", error.what());
    return 2;
  }
  return 0;
}
