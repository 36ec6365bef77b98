#include "host/photo/find_marks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "core/error.hpp"
#include "host/photo/marks.hpp"
#include "host/photo/sheet.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;
using picture::Colour;

constexpr double line_width = 0.6;
const core::Box frame{{15, 20}, {185, 110}};

bool in_mark(const Vec2& place, const Vec2& centre) {
  const MarkSizes sizes(line_width);
  const double radius = (place - centre).norm();
  return radius < sizes.disk || (radius > sizes.ring_inner && radius < sizes.ring_outer);
}

/// Paints what the bed shows at each place, as the view sees it.
Photo painted(const View& view, std::size_t width, std::size_t height,
              const std::function<Colour(const Vec2&)>& bed) {
  Photo photo(width, height);
  // The inverse of the view, by steps: slow, and independent of anything but pixel_of().
  for (std::size_t y = 0; y < height; ++y) {
    Vec2 place(100, 65);
    for (std::size_t x = 0; x < width; ++x) {
      const Vec2 wanted(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      for (int step = 0; step < 8; ++step) {
        const auto [along, up] = view.steps_at(place);
        const Vec2 off = wanted - view.pixel_of(place);
        const double whole = along.x() * up.y() - along.y() * up.x();
        const Vec2 move((off.x() * up.y() - off.y() * up.x()) / whole,
                        (along.x() * off.y() - along.y() * off.x()) / whole);
        place += move;
        if (move.norm() < 0.01) break;
      }
      photo.at(x, y) = bed(place);
    }
  }
  return photo;
}

View view_turned(double angle, double slant) {
  const Vec2 middle(450, 450);
  std::array<Vec2, 4> corners;
  const Vec2 bed_corners[] = {
      frame.min, {frame.max.x(), frame.min.y()}, frame.max, {frame.min.x(), frame.max.y()}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 off = bed_corners[i] - frame.center();
    const Vec2 turned(off.x() * std::cos(angle) - off.y() * std::sin(angle),
                      off.x() * std::sin(angle) + off.y() * std::cos(angle));
    const double nearer = 1 + slant * turned.y() / 100;
    corners[i] = middle + 3.8 * nearer * Vec2(turned.x(), -turned.y());
  }
  return View(frame, corners, {900, 900});
}

bool found_near(const std::vector<FoundMark>& marks, const Vec2& place, double tolerance) {
  return std::any_of(marks.begin(), marks.end(),
                     [&](const FoundMark& mark) { return (mark.centre - place).norm() < tolerance; });
}

Photo photo_of_marks(const View& view, const MarkPlaces& places, bool grid) {
  return painted(view, 900, 900, [&](const Vec2& place) -> Colour {
    for (const Vec2& centre : places) {
      if (in_mark(place, centre)) return {40, 90, 190};
    }
    const bool on_line = grid && (std::abs(std::remainder(place.x(), 10)) < 0.2 ||
                                  std::abs(std::remainder(place.y(), 10)) < 0.2);
    return on_line ? Colour{60, 80, 150} : Colour{205, 200, 190};
  });
}

}  // namespace

TEST_CASE("Round marks are found in any turn and slant, also where a grid on the bed crosses them",
          "[optimised]") {
  const MarkPlaces places = mark_places(frame);
  for (const double angle : {0.0, 0.7, 2.4, 3.1416, 5.0}) {
    for (const double slant : {0.0, 0.2}) {
      const View view = view_turned(angle, slant);
      const std::vector<FoundMark> marks = find_marks(photo_of_marks(view, places, angle > 1));
      CAPTURE(angle, slant, marks.size());
      for (const Vec2& place : places) CHECK(found_near(marks, view.pixel_of(place), 1));
    }
  }
}

TEST_CASE("Disks, squares and rings around bars are not marks") {
  const View view = view_turned(0.4, 0.1);
  const MarkSizes sizes(line_width);
  const Photo photo = painted(view, 900, 900, [&](const Vec2& place) -> Colour {
    const Colour dark{40, 40, 50}, light{220, 220, 220};
    const double radius = (place - Vec2(40, 40)).norm();
    const Vec2 square = (place - Vec2(120, 40)).cwiseAbs(), bar = (place - Vec2(150, 80)).cwiseAbs();
    const double around_bar = (place - Vec2(150, 80)).norm();
    if (radius < sizes.disk) return dark;
    if (square.maxCoeff() < 4) return dark;
    if (bar.x() < 2.4 && bar.y() < 0.6) return dark;
    if (around_bar > sizes.ring_inner && around_bar < sizes.ring_outer) return dark;
    return light;
  });
  CHECK(find_marks(photo).empty());
}

TEST_CASE("A sheet knows how the print is turned, by the two marks between the corners", "[optimised]") {
  SheetPlan plan;
  plan.marks = mark_places(frame);
  plan.line = line_width;
  for (const double angle : {0.0, 1.5708, 3.1416, 4.2}) {
    CAPTURE(angle);
    const View view = view_turned(angle, 0.1);
    const Photo photo = photo_of_marks(view, plan.marks, false);
    const Sheet sheet(photo, plan, {}, "photo.png");
    for (const Vec2& place : {Vec2(30, 30), Vec2(170, 50), Vec2(100, 100)})
      CHECK((sheet.view().pixel_of(place) - view.pixel_of(place)).norm() < 1);
    const SeenLight mark = sheet.light(plan.marks[4], {1, 0}, 0.8, 0.8);
    CHECK(picture::colour_of(mark.light) == Colour{40, 90, 190});
    CHECK(mark.pixels > 0);
    CHECK(sheet.light({900, 0}, {1, 0}, 1, 1).pixels == 0);
  }
}

TEST_CASE("A sheet without all its marks is refused, and so are corners from below") {
  SheetPlan plan;
  plan.marks = mark_places(frame);
  plan.line = line_width;
  MarkPlaces fewer = plan.marks;
  fewer[2] = fewer[4];
  const View view = view_turned(0.3, 0.1);
  const Photo photo = photo_of_marks(view, fewer, false);
  CHECK_THROWS_WITH(Sheet(photo, plan, {}, "photo.png"),
                    Catch::Contains("does not show the six round marks"));
  const GivenCorners corners{view.pixel_of(plan.marks[0]), view.pixel_of(plan.marks[1]),
                             view.pixel_of(plan.marks[2]), view.pixel_of(plan.marks[3])};
  const Sheet given(photo, plan, corners, "photo.png");
  CHECK((given.view().pixel_of({100, 60}) - view.pixel_of({100, 60})).norm() < 2);
  const GivenCorners turned{corners[3], corners[2], corners[1], corners[0]};
  CHECK_THROWS_WITH(Sheet(photo, plan, turned, "photo.png"), Catch::Contains("front left, front right"));
}

}  // namespace unicursal::host
