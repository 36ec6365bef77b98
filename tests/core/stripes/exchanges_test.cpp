#include "core/stripes/exchanges.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/core/support/fields.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;

namespace {

constexpr double pi = std::numbers::pi, w = 0.5;

/// Two strands along x, w apart, with round ends; counter-clockwise.
Curve stadium(const Vec2& middle, double length) {
  Curve curve;
  for (int k = 0; k <= 12; ++k)
    curve.vertices.push_back(middle + Vec2(length / 2, 0) +
                             w / 2 * Vec2(std::cos(pi * (k / 12.0 - 0.5)), std::sin(pi * (k / 12.0 - 0.5))));
  for (int k = 0; k <= 12; ++k)
    curve.vertices.push_back(middle - Vec2(length / 2, 0) -
                             w / 2 * Vec2(std::cos(pi * (k / 12.0 - 0.5)), std::sin(pi * (k / 12.0 - 0.5))));
  return curve;
}

Exchange cheapest(const std::vector<Curve>& loops, double reach) {
  const Polygon plate{{{-30, -10}, {30, -10}, {30, 10}, {-30, 10}}, {}};
  const DirectionField field = field_of(plate, 0.1, [](const Vec2&) { return 0.0; });
  const Chains chains = chains_of(loops, field, w / 4, 6);
  std::vector<std::size_t> alone;
  for (std::size_t l = 0; l < loops.size(); ++l) alone.push_back(l);
  const auto found = exchanges(chains, field, alone, std::vector<char>(chains.size(), 0), {w, reach, 5});
  REQUIRE(!found.empty());
  return found.front();
}

}  // namespace

TEST_CASE("a straight line off the field costs the square of its angle times its length") {
  const Polygon plate = rectangle(10, 10);
  const DirectionField field = field_of(plate, 0.1, [](const Vec2&) { return 0.2; });
  const auto line = [](double angle) {
    return Vec2(Vec2(5, 5) + 3 * Vec2(std::cos(angle), std::sin(angle)));
  };
  CHECK(off_field({5, 5}, line(0.2), field, 0.1) == Approx(0).margin(1e-9));
  CHECK(off_field({5, 5}, line(0.7), field, 0.1) == Approx(3 * 0.25));
  CHECK(off_field({5, 5}, line(0.2 + pi + 0.5), field, 0.1) == Approx(3 * 0.25));
}

TEST_CASE("an exchange between straight strands costs two round hairpins, where a strand ends clearly less") {
  // A round hairpin costs 2 ∫ a² da · w ÷ 2 over a quarter turn: 1.29 w.
  const double hairpin = std::pow(pi / 2, 3) / 3;
  const Exchange between = cheapest({stadium({0, 0}, 20), stadium({0, 2 * w}, 20)}, 1.7 * w);
  CHECK(between.cost > 2 * hairpin - 0.05);
  CHECK(between.cost < 2 * hairpin + 0.2);
  // Between two long loops, a third one ends in the middle. Its hairpin turns into one of the exchange, and
  // the strand beside it is led over into its row.
  const Exchange at_end =
      cheapest({stadium({-8, 0}, 10), stadium({0, 2 * w}, 30), stadium({0, -2 * w}, 30)}, 3 * w);
  CHECK(at_end.cost < 1.6 * hairpin);
}
