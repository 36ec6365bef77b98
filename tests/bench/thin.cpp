// Walls of every width, from half a bead to six, in bars, frames, crosses, ladders, combs, tubes and wedges,
// with 0, 1 and 2 perimeters: bench_thin [STEP [TURN [SHAPE [FROM]]]]. STEP is the step of the width in bead
// widths; default 0.25. TURN, in degrees, turns all shapes, SHAPE chooses one, and FROM is the first width. A
// width at which one method gives way to the next shows as a line that differs from its neighbours.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/border_index.hpp"
#include "core/planner/bare.hpp"
#include "core/planner/plan_island.hpp"
#include "sim/bed/spread.hpp"
#include "tests/core/support/thin_shapes.hpp"

namespace {

using namespace unicursal::core;
namespace sim = unicursal::sim;

constexpr double bead = 0.8, least = 0.36, greatest = 1.6;  ///< mm
constexpr double most_gaps = 0.03;                          ///< besides what is too thin
constexpr double layer = 0.3, pixel = 0.02;                 ///< mm; of the simulated bed

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

/// Share of the area without plastic when the simulated nozzle lays the beads, on a raster that is finer than
/// that of a dry run.
double gaps(const IslandPlan& plan, const Polygon& outline) {
  const Box box = bounds(outline);
  sim::Spread spread({box.size().x(), box.size().y()}, pixel, 1);
  spread.begin(layer, layer);
  for (const PlannedCurve& curve : plan.curves) {
    for (std::size_t k = 0; k < curve.path.size(); ++k) {
      const double volume = curve.path.beads[k].area * layer;
      if (!(volume > 0)) continue;
      const Vec2 a = curve.path.start(k) - box.min, b = curve.path.end(k) - box.min;
      sim::Bead laid{{a.x(), a.y(), layer}, {b.x(), b.y(), layer}, volume, {}, 0, 0};
      laid.shares[0] = 1;
      spread.lay(laid, curve.path.width(k));
    }
  }
  const sim::RasterFrame frame = spread.raster().frame();
  const BorderIndex border(outline, bead);
  std::vector<sim::RasterPixel> row(frame.columns);
  double filled = 0;
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    spread.raster().read_row(r, row);
    for (std::uint64_t c = 0; c < frame.columns; ++c) {
      const Vec2 at(frame.left + (static_cast<double>(c) + 0.5) * frame.pixel,
                    frame.bottom + (static_cast<double>(r) + 0.5) * frame.pixel);
      if (row[c].fill > 0 && border.contains(box.min + at))
        filled += std::min<double>(row[c].fill, 1) * frame.pixel * frame.pixel;
    }
  }
  return 1 - filled / area(outline);
}

}  // namespace

int main(int argc, char** argv) {
  const double step = argc > 1 ? std::max(std::atof(argv[1]), 0.01) : 0.25;
  const double turn = argc > 2 ? std::atof(argv[2]) : 0;
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
  fmt::print("gaps: share of the area without plastic on the simulated bed, %\n");
  fmt::print("bare: share of the area farther than 0.75 bead widths from the curve, %; too thin: of it, %\n");
  fmt::print(
      "axis: length of walls that are bare though a bead would fit, mm; odd: beads that cannot be laid, %\n");
  fmt::print("{:8} {:>5} {:>10} {:>6} {:>7} {:>8} {:>6} {:>6} {:>7}\n", "shape", "wall", "perimeters", "gaps",
             "bare", "too thin", "axis", "odd", "curves");
  double worst = 0, axis = 0;
  int jobs = 0, good = 0;
  for (const Shape& shape : shapes) {
    if (argc > 3 && shape.name != std::string(argv[3])) continue;
    for (int perimeters = 0; perimeters <= 2; ++perimeters) {
      for (double wall = argc > 4 ? std::atof(argv[4]) : 0.5; wall < 6 + step / 2; wall += step) {
        Island island;
        island.outline = test::turned(shape.make(wall * bead), turn);
        island.zones = {{0, {island.outline}}};
        PlanOptions options;
        options.bead_width = bead;
        options.min_bead_width = least;
        options.max_bead_width = greatest;
        options.perimeters = perimeters;
        const IslandPlan plan = plan_island(island, {Zone{}}, options);
        const Bare bare = look_for_bare(plan, island.outline, bead, least);
        const double whole = area(island.outline);
        const double left = gaps(plan, island.outline);
        ++jobs;
        good += left - plan.unfilled_area / whole <= most_gaps ? 1 : 0;
        fmt::print("{:8} {:5.2f} {:10} {:6.2f} {:7.2f} {:8.2f} {:6.2f} {:6.1f} {:7}\n", shape.name, wall,
                   perimeters, 100 * left, 100 * bare.area / whole, 100 * plan.unfilled_area / whole,
                   bare.axis_length, 100 * out_of_range(plan), plan.curves.size());
        worst = std::max(worst, (bare.area - plan.unfilled_area) / whole);
        axis = std::max(axis, bare.axis_length);
      }
    }
  }
  fmt::print("{} of {} have gaps of at most {:.0f} % besides what is too thin\n", good, jobs,
             100 * most_gaps);
  fmt::print("at most {:.2f} % bare though it could be laid, and {:.2f} mm of walls\n", 100 * worst, axis);
  return 0;
}
