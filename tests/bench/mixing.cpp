// Measures how precisely the mixtures come out where they are wanted, and how far the nozzle travels:
//   bench_mixing [--tanks N] [--volumes FACTOR] [--layers N] [--pictures DIR] JOB.toml …
//
// The same curves are encoded twice: with the look-ahead of the schedule, and switched at the borders. The
// chamber of the simulated printer has N tanks (3 by default) and FACTOR times the volumes of the profile (1
// by default), because the result must also hold for nozzles that differ from their profile. DIR receives a
// map of each layer's mixtures. A travel is a move of more than 1.5 bead widths without extruding. The volume
// laid outside the part excludes prime line and skirt.
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware_gcode/route/route.hpp"
#include "host/job/load_job.hpp"
#include "host/report/target.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/firmware/repetier.hpp"
#include "sim/motion/move_sinks.hpp"

namespace {

using namespace unicursal;

constexpr double raster_pixel = 0.05;  // mm

struct Options {
  std::size_t tanks = 3;
  double volumes = 1;
  std::size_t layers = static_cast<std::size_t>(-1);
  std::filesystem::path pictures;
};

/// Figures of one encoding of a job.
struct Result {
  host::DepositFindings findings;
  gcode::LayerMixing mixing;
  std::size_t travels_within = 0;   ///< travels from path to path of a layer
  std::size_t travels_between = 0;  ///< travels from one layer to the next
  std::size_t islands_left = 0;     ///< Σ (islands − 1)
  double travel = 0;                ///< mm, without the first approach
  double encoding = 0;              ///< processor seconds
};

class Judges : public sim::RasterSink {
 public:
  Judges(const host::PreparedJob& job, const std::vector<host::PlannedLayer>& layers,
         std::vector<host::IntendedMaterial> materials, std::filesystem::path pictures, Result& result)
      : job_(job),
        layers_(layers),
        materials_(std::move(materials)),
        pictures_(std::move(pictures)),
        result_(result) {}

  void layer(const sim::LayerRaster& raster) override {
    for (const host::PlannedLayer& planned : layers_) {
      const host::TargetLayer target = host::target_of(job_, planned, host::placed(job_, planned));
      if (std::abs(target.top - raster.frame().z) > target.height / 4 || target.zones.empty()) continue;
      std::uint64_t row = 0;
      const auto rows = [&](std::span<sim::RasterPixel> pixels) { raster.read_row(row++, pixels); };
      const bool draw = !pictures_.empty();
      const host::JudgedLayer judged = host::judge(target, raster.frame(), rows, materials_, draw);
      result_.findings += judged.findings;
      if (draw) {
        const char* how = job_.job.print.look_ahead ? "ahead" : "none";
        picture::write_png(
            pictures_ / fmt::format("{}-{}-{}.png", job_.job.file.stem().string(), target.index, how),
            *judged.mixtures);
      }
    }
  }

 private:
  const host::PreparedJob& job_;
  const std::vector<host::PlannedLayer>& layers_;
  std::vector<host::IntendedMaterial> materials_;
  std::filesystem::path pictures_;
  Result& result_;
};

/// Counts the moves that lay no plastic by their place.
class Travels : public sim::MoveSink {
 public:
  Travels(double longest, Result& result) : longest_(longest), result_(result) {}

  void moved(const sim::ExecutedMove& move) override {
    const bool bead = sim::lays_bead(move);
    if (!bead) {
      way_ += std::hypot(move.to.x - move.from.x, move.to.y - move.from.y);
      return;
    }
    const bool rises = move.from.z > z_ + 1e-6;
    // Every print has the way to the prime line and from there to the part.
    if (way_ > longest_ && approaches_++ >= 2) {
      ++(rises ? result_.travels_between : result_.travels_within);
      result_.travel += way_;
    }
    way_ = 0;
    z_ = move.to.z;
  }

 private:
  double longest_;
  Result& result_;
  double way_ = 0, z_ = 0;
  std::size_t approaches_ = 0;
};

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<host::PlannedLayer> plan(const host::PreparedJob& job, std::size_t most_layers) {
  host::LookaheadOptions options = host::lookahead_options(job);
  options.count = std::min(options.count, most_layers);
  host::Lookahead lookahead(*job.part, options);
  std::vector<host::PlannedLayer> layers;
  while (auto layer = lookahead.wait()) layers.push_back(std::move(*layer));
  return layers;
}

sim::Machine machine_of(const gcode::Printer& printer) {
  sim::Machine machine;
  machine.bed = printer.bed;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    machine.limits.max_speed[axis] = printer.max_speed[axis];
    machine.limits.max_acceleration[axis] = printer.max_acceleration[axis];
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

Result lay(const host::PreparedJob& job, const std::vector<host::PlannedLayer>& layers,
           const Options& options) {
  Result result;
  const gcode::Printer& printer = job.job.profile.printer;
  gcode::Encoder encoder(printer, host::print_settings(job));
  Judges judges(job, layers, host::intended_materials(job, encoder), options.pictures, result);
  Travels travels(gcode::travel_widths * job.job.bead_width, result);
  sim::Spread spread({printer.bed[0], printer.bed[1]}, raster_pixel, printer.feeders);
  sim::Deposit deposit({nullptr, &spread, &judges});
  sim::Nozzle nozzle(
      printer.filament_diameter,
      sim::Chamber(
          {options.volumes * printer.dead_volume, options.volumes * printer.mixing_volume, options.tanks}, 3),
      deposit);
  sim::MoveSinks sinks({&nozzle, &travels});
  const auto firmware =
      sim::make_firmware(machine_of(printer), sim::personality("marlin"), sinks, [](std::string_view) {});
  const auto pass = [&](auto&& encode) {
    const double begin = processor_seconds();
    const gcode::Chunk chunk = encode();
    result.encoding += processor_seconds() - begin;
    for (const gcode::LayerMixing& mixing : chunk.mixing) result.mixing += mixing;
    send(*firmware, chunk);
  };
  pass([&] { return encoder.start(); });
  for (const host::PlannedLayer& layer : layers) {
    pass([&] { return encoder.layer(host::placed(job, layer)); });
    if (!layer.layer.islands.empty()) result.islands_left += layer.layer.islands.size() - 1;
  }
  pass([&] { return encoder.rest(); });
  send(*firmware, encoder.finish());
  firmware->run_down();
  deposit.finish();
  return result;
}

void print(const char* what, const Result& r, double bead_width) {
  const host::DepositFindings& f = r.findings;
  fmt::print(
      "  {:13} wrong {:8.2f} mm² ({:.3f} %), 95 % of it within {:.2f} bead widths of the border; misplaced "
      "{:.2f} mm²\n",
      what, f.wrong, 100 * f.wrong_fraction(), f.wrong_distance.percentile(0.95) / bead_width,
      f.mixture_error);
  fmt::print(
      "                {} changes, {} switches, {} visits passed over ({:.2f} mm³); forecast: wrong {:.2f} "
      "mm³\n",
      r.mixing.changes, r.mixing.switches, r.mixing.passed_over, r.mixing.passed_over_volume, r.mixing.wrong);
  if (r.mixing.crossings > 0) {
    fmt::print(
        "                {} crossings of transition zones ({:.1f} mm²), {} of less than the mixing volume, "
        "the "
        "shortest {:.2f} mm³\n",
        r.mixing.crossings, f.transition, r.mixing.short_crossings, r.mixing.shortest_crossing);
  }
}

void measure(const char* file, const Options& options) {
  host::PreparedJob job = host::prepare(host::load_job(file));
  const auto layers = plan(job, options.layers);
  const double width = job.job.bead_width;
  const Result ahead = lay(job, layers, options);
  fmt::print("\n{}: {} layers, chamber of {:g} + {:g} mm³, {} tanks\n", file, layers.size(),
             job.job.profile.printer.dead_volume, job.job.profile.printer.mixing_volume, options.tanks);
  if (job.job.print.materials.size() > 1 || job.job.print.materials[0].gradient) {
    job.job.print.look_ahead = false;
    const Result late = lay(job, layers, options);
    print("look-ahead", ahead, width);
    print("none", late, width);
    fmt::print("  wrong area: 1/{:.1f} of that without look-ahead\n",
               late.findings.wrong / ahead.findings.wrong);
  }
  fmt::print("  travels: {} in layers ({} islands more than layers), {} between layers, {:.0f} mm in all\n",
             ahead.travels_within, ahead.islands_left, ahead.travels_between, ahead.travel);
  fmt::print("  outside the part: {:.3f} mm³; prime line {:.1f} mm³, skirt {:.1f} mm³\n",
             ahead.findings.outside, ahead.findings.prime, ahead.findings.skirt);
  fmt::print("  encoding: {:.3f} s of processor time for each layer\n",
             ahead.encoding / static_cast<double>(std::max<std::size_t>(1, layers.size())));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    for (int i = 1; i < argc; ++i) {
      const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0 && i + 1 < argc; };
      if (is("--tanks")) {
        options.tanks = std::strtoull(argv[++i], nullptr, 10);
      } else if (is("--volumes")) {
        options.volumes = std::strtod(argv[++i], nullptr);
      } else if (is("--pictures")) {
        options.pictures = argv[++i];
      } else if (is("--layers")) {
        options.layers = std::strtoull(argv[++i], nullptr, 10);
      } else {
        measure(argv[i], options);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_mixing: {}\n", error.what());
    return 2;
  }
  return 0;
}
