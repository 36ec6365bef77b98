#include "host/photo/view.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace unicursal::host {
namespace {

using core::Vec2;

const core::Box bed{{10, 20}, {190, 110}};

View slanted(double second, double fourth) {
  View view(bed, {Vec2(420, 2500), Vec2(3500, 2300), Vec2(3100, 700), Vec2(800, 900)}, {4000, 3000});
  View::Numbers numbers = view.numbers();
  numbers[8] = second, numbers[9] = fourth;
  view.set(numbers);
  return view;
}

std::vector<Sighting> grid_seen(const View& view) {
  std::vector<Sighting> seen;
  for (double x = 10; x <= 190; x += 20) {
    for (double y = 20; y <= 110; y += 15) seen.push_back({{x, y}, view.pixel_of({x, y}), {0, 0}, 1});
  }
  return seen;
}

}  // namespace

TEST_CASE(
    "A view without distortion shows straight lines as straight lines, and the corners where they are") {
  const View view = slanted(0, 0);
  CHECK((view.pixel_of({10, 20}) - Vec2(420, 2500)).norm() < 1e-6);
  CHECK((view.pixel_of({190, 110}) - Vec2(3100, 700)).norm() < 1e-6);
  const Vec2 a = view.pixel_of({10, 40}), b = view.pixel_of({70, 60}), c = view.pixel_of({190, 100});
  const Vec2 way = (c - a).normalized(), off = b - a;
  CHECK(std::abs(way.x() * off.y() - way.y() * off.x()) < 1e-6);
  CHECK(view.possible());
}

TEST_CASE("A lens moves places away from the middle of the photo with the square of their distance") {
  const View straight = slanted(0, 0), bent = slanted(0.1, -0.02);
  for (const Vec2& place : {Vec2(10, 20), Vec2(150, 90), Vec2(100, 65)}) {
    const Vec2 off = straight.pixel_of(place) - Vec2(2000, 1500);
    const double squared = off.squaredNorm() / (2500 * 2500);
    const Vec2 wanted = Vec2(2000, 1500) + off * (1 + 0.1 * squared - 0.02 * squared * squared);
    CHECK((bent.pixel_of(place) - wanted).norm() < 1e-6);
  }
}

TEST_CASE("A print that is seen from below or behind is impossible") {
  CHECK_FALSE(View(bed, {Vec2(800, 900), Vec2(3100, 700), Vec2(3500, 2300), Vec2(420, 2500)}, {4000, 3000})
                  .possible());
  CHECK_FALSE(View(bed, {Vec2(420, 2500), Vec2(3100, 700), Vec2(3500, 2300), Vec2(800, 900)}, {4000, 3000})
                  .possible());
}

TEST_CASE("A view is found from what was seen, although one place in ten was mistaken") {
  const View truth = slanted(-0.08, 0.03);
  std::vector<Sighting> seen = grid_seen(truth);
  for (std::size_t i = 0; i < seen.size(); i += 10) seen[i].pixel += Vec2(35, -50);
  View view(bed, {Vec2(430, 2480), Vec2(3480, 2310), Vec2(3120, 690), Vec2(790, 915)}, {4000, 3000});
  fit_view(view, seen, 2);
  for (double x = 10; x <= 190; x += 36) {
    for (double y = 20; y <= 110; y += 18)
      CHECK((view.pixel_of({x, y}) - truth.pixel_of({x, y})).norm() < 0.6);
  }
}

TEST_CASE(
    "Lines that are known across their direction only are enough, if they run in different directions") {
  const View truth = slanted(0.05, 0);
  std::vector<Sighting> seen;
  for (const Sighting& place : grid_seen(truth)) {
    for (const Vec2& normal : {Vec2(1, 0), Vec2(0.6, 0.8)}) {
      Sighting line = place;
      line.normal = normal;
      line.pixel += 40 * Vec2(-normal.y(), normal.x());  // along the line
      seen.push_back(line);
    }
  }
  View view = slanted(0, 0);
  CHECK(fit_view(view, seen, 1) < 1e-3);
  CHECK((view.pixel_of({150, 40}) - truth.pixel_of({150, 40})).norm() < 1e-2);
}

TEST_CASE("The scale of a view is that of its shorter direction") {
  const View view(bed, {Vec2(0, 900), Vec2(1800, 900), Vec2(1800, 450), Vec2(0, 450)}, {2000, 1500});
  CHECK(view.scale_at({100, 60}) == Approx(5).epsilon(1e-3));  // 450 pixels for 90 mm, 1800 for 180 mm
}

}  // namespace unicursal::host
