// Plans whole jobs with one thread and with two: bench_threads [--layers A:B] JOB.toml …
// Layers are planned side by side. Wall time says little on a computer that is also busy otherwise. Therefore
// the table also has the time that two idle cores would need: that of the busier core, if each layer goes to
// the core that is free first, as in the look-ahead.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <functional>
#include <vector>

#include "host/cli/arguments.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"

namespace {

using namespace unicursal;

struct Outcome {
  double wall = 0, cpu = 0;     ///< s
  std::vector<double> layers;   ///< processor time of each layer, s
  std::size_t fingerprint = 0;  ///< hash of all vertices and areas
  std::size_t vertices = 0;
};

void add(std::size_t& fingerprint, double value) {
  fingerprint = fingerprint * 1000003 + std::hash<double>{}(value);
}

Outcome plan(const host::PreparedJob& job, std::size_t threads) {
  host::LookaheadOptions options = host::lookahead_options(job);
  options.threads = threads;
  const auto start = std::chrono::steady_clock::now();
  host::Lookahead lookahead(*job.part, options);
  Outcome outcome;
  while (const std::optional<host::PlannedLayer> layer = lookahead.wait()) {
    outcome.layers.push_back(layer->cpu_seconds);
    for (const core::IslandPlan& island : layer->plans) {
      for (const core::PlannedCurve& curve : island.curves) {
        outcome.vertices += curve.path.size();
        for (const core::Bead& bead : curve.path.beads) {
          add(outcome.fingerprint, bead.position.x());
          add(outcome.fingerprint, bead.position.y());
          add(outcome.fingerprint, bead.area);
        }
      }
    }
  }
  outcome.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.cpu = lookahead.effort().cpu_seconds;
  return outcome;
}

/// The time at which the later of two cores is done if each takes the next layer when it is free, s.
double busier_core(const std::vector<double>& layers) {
  std::array<double, 2> busy{0, 0};
  for (const double seconds : layers) *std::min_element(busy.begin(), busy.end()) += seconds;
  return std::max(busy[0], busy[1]);
}

void measure(const char* file, const std::optional<host::LayerRange>& layers) {
  const host::PreparedJob job = host::prepare(host::load_job(file), layers);
  const Outcome one = plan(job, 1), two = plan(job, 2);
  fmt::print("{}: {} layers, {} vertices\n", file, one.layers.size(), one.vertices);
  fmt::print("  one thread {:.2f} s ({:.2f} CPU s), two {:.2f} s ({:.2f} CPU s): {:.2f} times as fast\n",
             one.wall, one.cpu, two.wall, two.cpu, one.wall / two.wall);
  fmt::print("  on two cores of their own {:.2f} times as fast; bytes {}\n",
             one.cpu / busier_core(two.layers), one.fingerprint == two.fingerprint ? "the same" : "OTHER");
}

}  // namespace

int main(int argc, char** argv) {
  std::optional<host::LayerRange> layers;
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::strcmp(argv[i], "--layers") == 0 && i + 1 < argc) {
        layers = host::parse_layers(argv[++i]);
      } else {
        measure(argv[i], layers);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_threads: {}\n", error.what());
    return 2;
  }
  return 0;
}
