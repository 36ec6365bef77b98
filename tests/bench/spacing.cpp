// Measures how the seed distance d determines the spacing: for each d ÷ w the length of the smoothed first
// cycle (the paper's target length), and the coverage after fairing to the spacing w. The default ratio comes
// from this table.
#include <fmt/core.h>

#include "core/curve/fairing.hpp"
#include "core/cycle/first_cycle.hpp"
#include "core/geometry/region.hpp"
#include "core/geometry/segment_diagram.hpp"

namespace {

using namespace unicursal::core;

void measure(double ratio, double side, double w) {
  const Polygon square{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
  double coverage = 0, natural = 0;
  constexpr int runs = 5;
  for (int run = 0; run < runs; ++run) {
    Random random(static_cast<std::uint64_t>(run));
    const Region domain = offset(offset({square}, -0.25 * w, 0.005 * w), 0.19 * w, 0.005 * w);
    const auto graph = make_cell_graph(domain.front(), ratio * w, random);
    const auto cycle = graph ? first_cycle(*graph) : std::nullopt;
    if (!cycle) continue;
    const Curve smooth = smoothed(drawn(cycle->tour), square, w);
    FairingOptions options;
    options.bead_width = w;
    options.target_length = area(square) / w;
    const Curve curve = fair(smooth, square, options).curve;
    double moment = 0;
    const SegmentDiagram diagram = segment_diagram(curve.vertices, square);
    for (const auto* cells : {&diagram.points, &diagram.segments}) {
      for (const CellIntegrals& cell : *cells) moment += cell.second_moment;
    }
    const double spacing = area(square) / curve.length();
    coverage += moment / (area(square) * spacing * spacing) / runs;
    natural += area(square) / smooth.length() / w / runs;
  }
  fmt::print("  d = {:.2f} w   natural spacing {:.3f} w   E after fairing {:.5f}\n", ratio, natural,
             coverage);
}

}  // namespace

int main() {
  fmt::print("square of 40 mm, bead width 1.0 mm, 5 seeds each\n");
  for (const double ratio : {1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9}) measure(ratio, 40, 1.0);
}
