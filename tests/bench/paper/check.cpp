#include "tests/bench/paper/check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/geometry/region.hpp"
#include "tests/bench/paper/fermat_spirals.hpp"
#include "tests/bench/paper/figures.hpp"
#include "tests/bench/paper/growth.hpp"
#include "tests/bench/paper/zigzag.hpp"
#include "tests/core/support/shapes.hpp"
#include "tests/core/support/thin_shapes.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;

constexpr double bead = 0.8;  ///< mm

/// What a method must reach on a shape.
struct Demanded {
  std::size_t most_lines = 1;
  double most_bare = 0.03;    ///< share of the area
  double mean_spacing = 0.1;  ///< greatest deviation from the bead width, as a share of it
};

std::string fault(const Filling& filling, const Polygon& island, const Demanded& demanded) {
  const std::vector<Line>& lines = filling.lines;
  if (lines.empty() || lines.size() > demanded.most_lines) return fmt::format("{} lines", lines.size());
  if (const std::size_t count = meetings(lines)) return fmt::format("{} segments meet", count);
  const core::BorderIndex border(island, bead);
  double length = 0;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.segments(); ++i) {
      length += line.length(i);
      if (!border.contains(line.start(i))) return "a point lies outside";
    }
    if (line.closed && core::segments_outside({line.points}, border) > 0)
      return "a segment leaves the island";
  }
  double moment = 0, bare = 0;
  areas_of(lines, island, bead, moment, bare);
  const double area = core::area(island), spacing = area / length / bead;
  if (bare > demanded.most_bare * area) return fmt::format("{:.1f} % is bare", 100 * bare / area);
  if (std::abs(spacing - 1) > demanded.mean_spacing)
    return fmt::format("spacing {:.2f} bead widths", spacing);
  return "";
}

}  // namespace

std::vector<std::string> faults_of_methods() {
  const Polygon square = core::test::rectangle(14, 14), comb = core::test::comb_of_teeth(4);
  const Polygon holed = core::test::square_with_hole(), disc{core::test::circle({0, 0}, 7, 60), {}};
  struct Case {
    const char* method;
    const char* shape;
    std::function<Filling()> fill;
    const Polygon& island;
    Demanded demanded;
  };
  std::vector<std::string> faults;
  for (const Case& c :
       {Case{"zigzag", "square", [&] { return zigzag(square, bead); }, square, {1}},
        Case{"zigzag", "comb", [&] { return zigzag(comb, bead); }, comb, {6, 0.08, 0.2}},
        Case{"zigzag", "square with a hole", [&] { return zigzag(holed, bead); }, holed, {4}},
        Case{"fermat", "square", [&] { return fermat_spirals(square, bead); }, square, {1}},
        Case{"fermat", "disc", [&] { return fermat_spirals(disc, bead); }, disc, {1}},
        Case{"fermat", "comb", [&] { return fermat_spirals(comb, bead); }, comb, {1, 0.06, 0.2}},
        Case{"fermat",
             "square with a hole",
             [&] { return fermat_spirals(holed, bead); },
             holed,
             {1, 0.06, 0.2}},
        Case{"growth", "disc", [&] { return growth(disc, bead); }, disc, {1, 0.05, 0.1}}}) {
    const std::string found = fault(c.fill(), c.island, c.demanded);
    if (!found.empty()) faults.push_back(fmt::format("{} on a {}: {}", c.method, c.shape, found));
  }
  return faults;
}

}  // namespace unicursal::bench
