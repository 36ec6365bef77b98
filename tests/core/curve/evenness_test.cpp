#include "core/curve/evenness.hpp"

#include <catch2/catch.hpp>
#include <numeric>

using namespace unicursal::core;

namespace {

/// A closed path along a rectangle in steps of `step` mm; its upper half is twice as wide.
BeadPath rectangle_path(double width, double height, double step) {
  BeadPath path;
  const std::vector<Vec2> corners{{0, 0}, {width, 0}, {width, height}, {0, height}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 a = corners[k], b = corners[(k + 1) % 4];
    const auto pieces = static_cast<int>((b - a).norm() / step);
    for (int i = 0; i < pieces; ++i) {
      const Vec2 from = a + (b - a) * (static_cast<double>(i) / pieces);
      path.beads.push_back({from, (k == 2 ? 2.0 : 1.0) * step, 0});
    }
  }
  return path;
}

}  // namespace

TEST_CASE("the width around a bead is area over length of the window about its middle") {
  const BeadPath path = rectangle_path(10, 2, 0.25);
  const std::vector<double> widths = widths_around(path, 1);
  REQUIRE(widths.size() == path.size());
  CHECK(widths[20] == Approx(1));       // middle of the lower side
  CHECK(widths[48 + 20] == Approx(2));  // middle of the upper side
  CHECK(widths[48] == Approx(1.625));   // first bead of the upper side, which has 5/8 of the window
  CHECK(widths[47] == Approx(1.375));
  CHECK(widths[0] == Approx(1));  // the window reaches back past the start
  // The windows add up to the path's area, since the beads are equally long.
  CHECK(std::accumulate(widths.begin(), widths.end(), 0.0) * 0.25 == Approx(path.total_area()));
}

TEST_CASE("widths are finite around beads of no length and on paths shorter than the window") {
  BeadPath path = rectangle_path(10, 2, 0.25);
  path.beads.insert(path.beads.begin() + 5, {path.beads[5].position, 0.5, 0});
  const std::vector<double> widths = widths_around(path, 1);
  CHECK(widths[5] == Approx(1.5));  // the window contains the area of the bead of no length
  CHECK(widths[30] == Approx(1));
  const BeadPath small = rectangle_path(0.5, 0.25, 0.25);
  for (const double width : widths_around(small, 2))
    CHECK(width == Approx(small.total_area() / small.total_length()));
  CHECK(widths_around({}, 1).empty());
}
