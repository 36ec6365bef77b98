#include "host/report/stage_pictures.hpp"

#include <catch2/catch.hpp>

#include "host/report/canvas.hpp"

namespace unicursal::host {
namespace {

using picture::Colour;

constexpr Colour paper{255, 255, 255}, ink{0, 0, 0};

bool redder(Colour a, Colour b) {
  return a.r - a.b > b.r - b.b;
}

}  // namespace

TEST_CASE("Narrow beads are blue, wide ones red, and beyond the scale nothing changes") {
  double last = 0.5;
  for (const double ratio : {0.6, 0.8, 1.0, 1.2, 1.5}) {
    CHECK(redder(width_colour(ratio), width_colour(last)));
    last = ratio;
  }
  CHECK(width_colour(0) == width_colour(0.5));
  CHECK(width_colour(9) == width_colour(1.5));
  CHECK(width_colour(0.5).b > width_colour(0.5).r);
  CHECK(width_colour(1.5).r > width_colour(1.5).b);
}

TEST_CASE("A canvas draws in mm with y up, and centres narrow drawings") {
  const core::Box extent{{10, 20}, {14, 22}};
  Canvas canvas({extent, 10, 0, 30}, paper);
  CHECK(canvas.image().width() == 40 + 16);
  CHECK(canvas.image().height() == 20 + 16 + 30);
  CHECK(canvas.at({10, 22}).isApprox(core::Vec2(8, 8)));
  CHECK(canvas.at({14, 20}).isApprox(core::Vec2(48, 28)));
  const core::Polygon lower{{{10, 20}, {14, 20}, {14, 21}, {10, 21}},
                            {{{11, 20.2}, {11, 20.8}, {12, 20.8}, {12, 20.2}}}};
  canvas.fill(lower, ink);
  CHECK(canvas.image().at(10, 12) == paper);  // above it
  CHECK(canvas.image().at(10, 20) == ink);
  CHECK(canvas.image().at(22, 23) == paper);  // in the hole
  CHECK(canvas.image().at(35, 23) == ink);
  CHECK(canvas.image().at(35, 29) == paper);  // below it
  const Canvas wide({extent, 10, 100, 0}, paper);
  CHECK(wide.image().width() == 100);
  CHECK(wide.at({12, 21}).x() == Approx(50));
}

TEST_CASE("Pictures are as large as their beads, up to a limit") {
  const core::Box extent{{0, 0}, {100, 50}};
  CHECK(scale_for(extent, 0.5, 10, 4000) == Approx(20));
  CHECK(scale_for(extent, 0.5, 10, 1000) == Approx(10));
  CHECK(scale_for({{3, 3}, {3, 3}}, 0.5, 10, 1000) == Approx(20));
}

}  // namespace unicursal::host
