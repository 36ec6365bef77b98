#include "host/photo/even_light.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace unicursal::host {
namespace {

using core::Vec2;
using picture::Light;

const core::Box sheet{{10, 10}, {190, 110}};
const Light blue{0.05, 0.12, 0.5}, red{0.45, 0.06, 0.05};

/// Darker to the left, with a warm lamp at the right; down to half.
Light lit(const Light& light, const Vec2& place) {
  const double fall = std::exp(-0.35 * (190 - place.x()) / 180);
  const double lamp = std::exp(-(place - Vec2(160, 80)).squaredNorm() / (2 * 90 * 90));
  return {light[0] * fall * (1 + 0.35 * lamp), light[1] * fall * (1 + 0.25 * lamp), light[2] * fall};
}

std::vector<KnownPlace> everywhere(const Light& light, std::size_t material, double step) {
  std::vector<KnownPlace> known;
  for (double x = 12; x < 190; x += step) {
    for (double y = 12; y < 110; y += step) known.push_back({{x, y}, lit(light, {x, y}), material});
  }
  return known;
}

}  // namespace

TEST_CASE("Uneven light is cancelled to some per cent, for other materials too") {
  std::vector<KnownPlace> known = everywhere(blue, 0, 11);
  for (double x = 12; x < 60; x += 4) known.push_back({{x, 40}, lit(red, {x, 40}), 1});
  const EvenLight even(known, sheet);
  const Light there = even.evened({30, 30}, lit(red, {30, 30})),
              here = even.evened({170, 90}, lit(red, {170, 90}));
  for (std::size_t c = 0; c < 3; ++c) CHECK(there[c] / here[c] == Approx(1).margin(0.04));
  CHECK(lit(red, {170, 90})[0] / lit(red, {30, 30})[0] > 1.5);  // which was to be cancelled
}

TEST_CASE("A glare on some places changes hardly anything elsewhere") {
  std::vector<KnownPlace> known = everywhere(blue, 0, 11);
  const EvenLight without(known, sheet);
  for (KnownPlace& one : known) {
    if ((one.place - Vec2(100, 60)).norm() > 20) continue;
    for (double& channel : one.light) channel += 0.4;
  }
  const EvenLight with(known, sheet);
  for (const Vec2& place : {Vec2(20, 20), Vec2(180, 30), Vec2(60, 100), Vec2(100, 60)}) {
    const Light a = without.evened(place, blue), b = with.evened(place, blue);
    for (std::size_t c = 0; c < 3; ++c) CHECK(b[c] / a[c] == Approx(1).margin(0.05));
  }
}

TEST_CASE("One place alone says nothing about how the light falls") {
  const EvenLight even({{{50, 50}, blue, 0}}, sheet);
  const Light seen = even.evened({150, 90}, red);
  for (std::size_t c = 0; c < 3; ++c) CHECK(seen[c] == Approx(red[c]));
}

}  // namespace unicursal::host
