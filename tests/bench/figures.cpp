// Figures of the curves of whole jobs: bench_figures [--layers N] JOB.toml …
// Plans every layer of every job and prints the mean and the worst of the figures that a print depends on.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <vector>

#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "host/report/peak_memory.hpp"

namespace {

using namespace unicursal;

/// Islands smaller than this many square bead widths consist of border; their spacing is reported separately.
constexpr double small_island = 200;

struct Worst {
  std::size_t layers = 0, islands = 0, curves = 0, empty = 0, broken = 0, reconnected = 0, doubled = 0,
              vertices = 0;
  double farthest = 0, far_area = 0, unfilled = 0, spacing = 0, small_spacing = 0, coverage = 0,
         area_error = 0, alignment = 0, isotropy = 0, anisotropy = 0, variation = 0;
  std::size_t crossings = 0, judged = 0;
  double mean_coverage = 0, mean_alignment = 0, mean_isotropy = 0, mean_anisotropy = 0, mean_variation = 0;
  double area = 0, length = 0;
  core::StageTime graph, cycle, fairing, widths;
};

void add(core::StageTime& sum, const core::StageTime& more) {
  sum.seconds += more.seconds;
  sum.cpu_seconds += more.cpu_seconds;
}

void add(Worst& w, const core::Island& island, const core::IslandPlan& plan, double bead_width) {
  ++w.islands;
  if (plan.curves.empty()) ++w.empty;
  double filled = 0, length = 0;
  for (const core::PlannedCurve& curve : plan.curves) {
    ++w.curves;
    w.broken += curve.self_intersections + curve.outside_segments;
    w.reconnected += curve.split_and_reconnect;
    w.doubled += curve.doubled_edges;
    w.vertices += curve.path.size();
    w.farthest = std::max(w.farthest, curve.farthest / bead_width);
    filled += curve.path.total_area();
    length += curve.path.total_length();
    if (curve.area > small_island * bead_width * bead_width) {
      w.coverage = std::max(w.coverage, curve.objectives.normalised_coverage);
      w.alignment = std::max(w.alignment, curve.objectives.alignment);
      w.isotropy = std::max(w.isotropy, curve.objectives.isotropy);
      w.anisotropy = std::max(w.anisotropy, curve.objectives.anisotropy);
      w.variation = std::max(w.variation, curve.objectives.width_variation);
      ++w.judged;
      w.mean_coverage += curve.objectives.normalised_coverage;
      w.mean_alignment += curve.objectives.alignment;
      w.mean_isotropy += curve.objectives.isotropy;
      w.mean_anisotropy += curve.objectives.anisotropy;
      w.mean_variation += curve.objectives.width_variation;
      w.crossings = std::max(w.crossings, curve.zone_crossings);
    }
  }
  const double whole = area(island.outline);
  if (length > 0) {
    double& worst = whole > small_island * bead_width * bead_width ? w.spacing : w.small_spacing;
    worst = std::max(worst, std::abs(filled / length / bead_width - 1));
  }
  w.area_error = std::max(w.area_error, std::abs(filled + plan.unfilled_area - whole) / whole);
  w.far_area += plan.far_area;
  w.unfilled += plan.unfilled_area;
  w.area += filled;
  w.length += length;
  add(w.graph, plan.graph);
  add(w.cycle, plan.cycle);
  add(w.fairing, plan.fairing);
  add(w.widths, plan.widths);
}

void print(const std::string& name, const Worst& w, double bead_width, const host::Lookahead& lookahead) {
  fmt::print("\n{}\n", name);
  fmt::print("  layers {}, islands {}, curves {}, islands without a curve {}, vertices {}\n", w.layers,
             w.islands, w.curves, w.empty, w.vertices);
  fmt::print("  crossings of a curve with itself or the border    {}\n", w.broken);
  fmt::print("  farthest point from the curve, bead widths        {:.3f}\n", w.farthest);
  fmt::print("  farther than 1.2 bead widths / too thin, mm²      {:.4f} / {:.4f}\n", w.far_area, w.unfilled);
  fmt::print("  mean spacing against bead width, all together     {:+.3f} %\n",
             100 * (w.area / w.length / bead_width - 1));
  fmt::print("    worst island / worst small island               {:.2f} % / {:.0f} %\n", 100 * w.spacing,
             100 * w.small_spacing);
  const double n = static_cast<double>(std::max<std::size_t>(w.judged, 1));
  fmt::print("  E = E_CVT ÷ (A·w²), mean / worst                  {:.4f} / {:.4f}\n", w.mean_coverage / n,
             w.coverage);
  fmt::print("  W = E_iso of isotropic zones, rad²                {:.1e} / {:.1e}\n", w.mean_isotropy / n,
             w.isotropy);
  fmt::print("  ali, squared angle to the asked directions, rad²  {:.3f} / {:.3f}\n", w.mean_alignment / n,
             w.alignment);
  fmt::print("  E_aniso of anisotropic zones, rad²                {:.3f} / {:.3f}\n", w.mean_anisotropy / n,
             w.anisotropy);
  fmt::print("  CV of the bead width over windows of one w        {:.4f} / {:.4f}\n", w.mean_variation / n,
             w.variation);
  fmt::print("  crossings of material borders a curve, at most    {}\n", w.crossings);
  fmt::print("  segment areas and unfilled area against the island {:.1e}\n", w.area_error);
  fmt::print("  split-and-reconnect / doubled edges               {} / {}\n", w.reconnected, w.doubled);
  fmt::print(
      "  CPU s: graph {:.2f}, cycle {:.2f}, fairing {:.2f}, widths {:.2f}; planning {:.2f} s on {} threads, "
      "peak {:.0f} MiB\n",
      w.graph.cpu_seconds, w.cycle.cpu_seconds, w.fairing.cpu_seconds, w.widths.cpu_seconds,
      lookahead.effort().seconds, lookahead.threads(), host::peak_memory());
}

void measure(const char* file, std::size_t most_layers) {
  const host::PreparedJob job = host::prepare(host::load_job(file));
  host::LookaheadOptions options = host::lookahead_options(job);
  options.count = std::min(options.count, most_layers);
  host::Lookahead lookahead(*job.part, options);
  Worst worst;
  while (const std::optional<host::PlannedLayer> layer = lookahead.wait()) {
    ++worst.layers;
    for (std::size_t i = 0; i < layer->plans.size(); ++i) {
      add(worst, layer->layer.islands[i], layer->plans[i], job.job.bead_width);
    }
  }
  print(file, worst, job.job.bead_width, lookahead);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t most_layers = static_cast<std::size_t>(-1);
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::strcmp(argv[i], "--layers") == 0 && i + 1 < argc) {
        most_layers = std::strtoull(argv[++i], nullptr, 10);
      } else {
        measure(argv[i], most_layers);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_figures: {}\n", error.what());
    return 2;
  }
  return 0;
}
