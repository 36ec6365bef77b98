// Measures how planning grows with the island: squares of more and more nodes, the time to the first valid
// curve, and one thread against two on the same island (--threads runs this alone). --plate [THREADS] plans a
// plate of 300 × 300 mm at 0.45 mm instead.
#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <thread>
#include <vector>

#include "core/curve/clearance.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/planner/fillable.hpp"
#include "core/planner/plan_island.hpp"

namespace {

using namespace unicursal::core;

constexpr double width = 1.0;                           ///< mm, of a bead in all squares except the plate
constexpr double seed_distance = 1.6;                   ///< bead widths, about the default of the planner
constexpr double plate_side = 300, plate_width = 0.45;  ///< mm

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of all threads, s.
double cpu() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Side of a square whose graph has about `nodes` nodes: three for each cell of area √3/2 d².
double side_of(double nodes, double w) {
  const double d = seed_distance * w;
  return std::sqrt(nodes / 3 * std::sqrt(3.0) / 2 * d * d);
}

Polygon square(double side) {
  return {{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
}

struct Run {
  IslandPlan plan;
  double cpu = 0, wall = 0;
  std::size_t vertices() const { return plan.curves.empty() ? 0 : plan.curves.front().path.size(); }
};

Run plan(double side, double w, int threads) {
  Island island;
  island.outline = square(side);
  island.zones = {{0, {island.outline}}};
  PlanOptions options;
  options.bead_width = w;
  options.threads = threads;
  const double cpu0 = cpu(), wall0 = wall();
  Run run{plan_island(island, {Zone{}}, options)};
  run.cpu = cpu() - cpu0;
  run.wall = wall() - wall0;
  return run;
}

void print_row(double nodes, const Run& run, double first) {
  const IslandPlan& p = run.plan;
  const double each = 1e6 / static_cast<double>(run.vertices());
  fmt::print("{:9.0f} {:9} {:8.2f} {:8.2f} {:7.2f} {:7.2f} {:8.2f} {:8.2f} {:7.2f}\n", nodes, run.vertices(),
             run.cpu, each * run.cpu, each * p.graph.cpu_seconds, each * p.cycle.cpu_seconds,
             each * p.fairing.cpu_seconds, each * p.widths.cpu_seconds, each * run.cpu / first);
}

void squares() {
  fmt::print("squares, isotropic, one thread: CPU time\n");
  fmt::print("{:>9} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8} {:>8} {:>7}\n", "nodes", "vertices", "s", "µs/vert.",
             "graph", "cycle", "fairing", "widths", "growth");
  double first = 0;
  for (const double nodes : {4e3, 1e4, 3e4, 1e5}) {
    const Run run = plan(side_of(nodes, width), width, 1);
    if (first == 0) first = 1e6 * run.cpu / static_cast<double>(run.vertices());
    print_row(nodes, run, first);
  }
}

void first_curve() {
  const Polygon island = square(side_of(1e4, width));
  const double start = cpu();
  const Fillable parts = fillable(island, width, width / 4);
  Random random(1);
  const auto graph = make_cell_graph(parts.regions.front().domain, seed_distance * width, random);
  const auto cycle = graph ? first_cycle(*graph) : std::nullopt;
  const Curve curve = cycle ? drawn(cycle->tour) : Curve{};
  const bool valid = curve.size() >= 5 && self_intersections(curve) == 0 &&
                     segments_outside(curve, BorderIndex(island, width)) == 0;
  fmt::print("\nfirst valid curve: {} vertices, {:.3f} CPU s{}\n", curve.size(), cpu() - start,
             valid ? "" : "  NOT VALID");
}

bool same(const BeadPath& a, const BeadPath& b) {
  bool equal = a.size() == b.size();
  for (std::size_t i = 0; equal && i < a.size(); ++i) {
    equal = a.beads[i].position == b.beads[i].position && a.beads[i].area == b.beads[i].area;
  }
  return equal;
}

void threads(double nodes) {
  const double side = side_of(nodes, width);
  const Run one = plan(side, width, 1), two = plan(side, width, 2);
  fmt::print(
      "{:.0f} nodes, one thread {:.2f} s, two {:.2f} s: {:.2f} times as fast, {} bytes, {:.0f} % more CPU\n",
      nodes, one.wall, two.wall, one.wall / two.wall,
      same(one.plan.curves.front().path, two.plan.curves.front().path) ? "the same" : "OTHER",
      100 * (two.cpu / one.cpu - 1));
}

void plate(int count) {
  fmt::print("\n{:.0f} × {:.0f} mm at {} mm, {} thread{}\n", plate_side, plate_side, plate_width, count,
             count > 1 ? "s" : "");
  const Run run = plan(plate_side, plate_width, count);
  const PlannedCurve& curve = run.plan.curves.front();
  fmt::print(
      "  vertices {}, wall {:.0f} s, CPU {:.0f} s, peak {:.0f} MiB, E {:.4f}, crossings {}, outside {}\n",
      run.vertices(), run.wall, run.cpu, peak_memory(), curve.objectives.normalised_coverage,
      curve.self_intersections, curve.outside_segments);
}

}  // namespace

int main(int argc, char** argv) {
  const int cores = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
  if (argc > 1 && std::strcmp(argv[1], "--plate") == 0) {
    plate(argc > 2 ? std::atoi(argv[2]) : cores);
    return 0;
  }
  if (argc < 2) {
    squares();
    first_curve();
    fmt::print("\n");
  }
  for (const double nodes : {4e3, 3e4}) threads(nodes);
}
