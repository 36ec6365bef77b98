// Walls of every width, from half a bead to six, in bars, frames, crosses, ladders, combs, tubes and wedges,
// with 0, 1 and 2 perimeters: bench_thin [STEP]. STEP is the step of the width in bead widths; default 0.25.
// A width at which one method gives way to the next shows as a line that differs from its neighbours.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/planner/bare.hpp"
#include "core/planner/plan_island.hpp"
#include "tests/core/support/thin_shapes.hpp"

namespace {

using namespace unicursal::core;

constexpr double bead = 0.8, least = 0.36, greatest = 1.6;  ///< mm

struct Shape {
  const char* name;
  std::function<Polygon(double wall)> make;
};

/// Share of the beads' length that is narrower or wider than can be laid.
double out_of_range(const IslandPlan& plan) {
  double out = 0, all = 0;
  for (const PlannedCurve& curve : plan.curves) {
    out += curve.narrow_length + curve.wide_length;
    all += curve.path.total_length();
  }
  return all > 0 ? out / all : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const double step = argc > 1 ? std::max(std::atof(argv[1]), 0.01) : 0.25;
  const std::vector<Shape> shapes = {
      {"bar", [](double wall) { return test::rectangle(30, wall); }},
      {"frame", test::frame},
      {"cross", test::cross_of_bars},
      {"ladder", test::ladder},
      {"comb", test::comb_of_teeth},
      {"tube", [](double wall) { return test::tube(9, wall); }},
      {"wedge", test::wedge},
  };
  fmt::print("beads of {} mm, {} to {} mm\n", bead, least, greatest);
  fmt::print("bare: share of the area farther than 0.75 bead widths from the curve, %; too thin: of it, %\n");
  fmt::print(
      "axis: length of walls that are bare though a bead would fit, mm; odd: beads that cannot be laid, %\n");
  fmt::print("{:8} {:>5} {:>10} {:>7} {:>8} {:>6} {:>6} {:>7}\n", "shape", "wall", "perimeters", "bare",
             "too thin", "axis", "odd", "curves");
  double worst = 0, axis = 0;
  for (const Shape& shape : shapes) {
    for (int perimeters = 0; perimeters <= 2; ++perimeters) {
      for (double wall = 0.5; wall < 6 + step / 2; wall += step) {
        Island island;
        island.outline = shape.make(wall * bead);
        island.zones = {{0, {island.outline}}};
        PlanOptions options;
        options.bead_width = bead;
        options.min_bead_width = least;
        options.max_bead_width = greatest;
        options.perimeters = perimeters;
        const IslandPlan plan = plan_island(island, {Zone{}}, options);
        const Bare bare = look_for_bare(plan, island.outline, bead, least);
        const double whole = area(island.outline);
        fmt::print("{:8} {:5.2f} {:10} {:7.2f} {:8.2f} {:6.2f} {:6.1f} {:7}\n", shape.name, wall, perimeters,
                   100 * bare.area / whole, 100 * plan.unfilled_area / whole, bare.axis_length,
                   100 * out_of_range(plan), plan.curves.size());
        worst = std::max(worst, (bare.area - plan.unfilled_area) / whole);
        axis = std::max(axis, bare.axis_length);
      }
    }
  }
  fmt::print("at most {:.2f} % bare though it could be laid, and {:.2f} mm of walls\n", 100 * worst, axis);
  return 0;
}
