// Plans a leaf-like plate with many thin branches (paper, Figure 18; its own leaf of 146 × 160 mm took 369
// s): bench_leaf [FILE.svg]. The outline is written to the file; `unicursal curve --picture` can draw it.
#include <fmt/core.h>

#include <ctime>
#include <fstream>

#include "core/planner/plan_island.hpp"
#include "tests/bench/leaf_plate.hpp"

namespace {

using namespace unicursal::core;
using namespace unicursal::bench;

constexpr double spacing = 0.8, least_width = 0.4, greatest_width = 1.4;  ///< mm, of the beads

double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void write_svg(const char* file, const Polygon& plate) {
  std::ofstream svg(file);
  svg << fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
      "<path fill=\"#0000ff\" fill-rule=\"evenodd\" d=\"",
      leaf_width, leaf_height);
  const auto draw = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      svg << fmt::format("{}{:.4f},{:.4f} ", i == 0 ? 'M' : 'L', ring[i].x() + leaf_width / 2,
                         leaf_height - ring[i].y());
    svg << "Z\n";
  };
  draw(plate.outer);
  for (const Ring& hole : plate.holes) draw(hole);
  svg << "\"/>\n</svg>\n";
}

void print(const Polygon& plate, const IslandPlan& plan, double seconds) {
  const Vec2 size = bounds(plate).size();
  fmt::print("a leaf's skeleton, {:.0f} × {:.0f} mm, {:.0f} mm², {} holes, beads of {} mm\n", size.x(),
             size.y(), area(plate), plate.holes.size(), spacing);
  for (const PlannedCurve& curve : plan.curves) {
    fmt::print(
        "  N {}, mean spacing {:.3f} mm, E {:.4f}, CV {:.4f}, farthest {:.2f} mm, crossings {}, outside {}\n",
        curve.path.size(), curve.path.total_area() / curve.path.total_length(),
        curve.objectives.normalised_coverage, curve.objectives.width_variation, curve.farthest,
        curve.self_intersections, curve.outside_segments);
    fmt::print("  narrower than {} mm {:.1f} mm of {:.0f}, wider than {} mm {:.1f} mm\n", least_width,
               curve.narrow_length, curve.path.total_length(), greatest_width, curve.wide_length);
  }
  fmt::print("  curves {}, not filled {:.3f} mm², too far from a bead {:.3f} mm²\n", plan.curves.size(),
             plan.unfilled_area, plan.far_area);
  fmt::print("  CPU s: {:.2f}; graph {:.2f}, cycle {:.2f}, fairing {:.2f}, widths {:.2f}\n", seconds,
             plan.graph.cpu_seconds, plan.cycle.cpu_seconds, plan.fairing.cpu_seconds,
             plan.widths.cpu_seconds);
}

}  // namespace

int main(int argc, char** argv) {
  Island island;
  island.outline = leaf_plate();
  island.zones = {{0, {island.outline}}};
  if (argc > 1) write_svg(argv[1], island.outline);
  PlanOptions options;
  options.bead_width = spacing;
  options.min_bead_width = least_width;
  options.max_bead_width = greatest_width;
  const double start = cpu();
  const IslandPlan plan = plan_island(island, {Zone{}}, options);
  print(island.outline, plan, cpu() - start);
  return 0;
}
