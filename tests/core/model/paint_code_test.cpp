#include "core/model/paint_code.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <map>

#include "core/text/malformed.hpp"

using namespace unicursal::core;

namespace {

/// Share of the triangle that each filament has.
std::map<std::size_t, double> shares(std::string_view code) {
  std::map<std::size_t, double> result;
  for (const PaintedLeaf& leaf : painted_leaves(code)) {
    const Vec3 normal = (leaf.corners[1] - leaf.corners[0]).cross(leaf.corners[2] - leaf.corners[0]);
    CHECK(normal.sum() > 0);  // all leaves face the same way as the triangle
    result[leaf.filament] += normal.norm() / std::sqrt(3.0);
  }
  return result;
}

}  // namespace

TEST_CASE("a triangle of one filament is a digit, or two from the third filament on") {
  const auto filament = [](std::string_view code) { return painted_leaves(code).at(0).filament; };
  CHECK(painted_leaves("0").empty());
  CHECK(filament("4") == 1);
  CHECK(filament("8") == 2);
  CHECK(filament("0C") == 3);
  CHECK(filament("1c") == 4);
  CHECK(filament("DC") == 16);
}

TEST_CASE("divided triangles are read from the end, their last part first") {
  // One side divided: two halves; the part that is written first is (middle, third, first corner).
  const auto halves = painted_leaves("481");
  REQUIRE(halves.size() == 2);
  CHECK(halves[0].filament == 2);
  CHECK(halves[0].corners[0] == Vec3(0, 0.5, 0.5));
  CHECK(halves[0].corners[2] == Vec3(1, 0, 0));
  CHECK(halves[1].corners[0] == Vec3(1, 0, 0));
  CHECK(shares("481").at(1) == Approx(0.5));
  CHECK(shares("481").at(2) == Approx(0.5));
  // The side that is divided lies opposite of another corner.
  CHECK(painted_leaves("485")[1].corners[0] == Vec3(0, 1, 0));
  const auto three = shares("4802");
  CHECK(three.at(1) == Approx(0.25));
  CHECK(three.at(2) == Approx(0.25));
  const auto four = shares("44483");
  CHECK(four.at(1) == Approx(0.75));
  CHECK(four.at(2) == Approx(0.25));
  // The middle part is written first.
  CHECK(painted_leaves("44483")[0].corners[0] == Vec3(0.5, 0.5, 0));
  const auto deep = shares(
      "444"
      "888"
      "83"
      "3");
  CHECK(deep.at(1) == Approx(0.75));
  CHECK(deep.at(2) == Approx(0.25));
}

TEST_CASE("what is not a tree is refused") {
  for (const char* code : {"", "g", "3", "443", "44", "C", "4443x", "d", "44d"}) {
    CAPTURE(code);
    CHECK_THROWS_AS(painted_leaves(code), Malformed);
  }
  CHECK_THROWS_AS(painted_leaves(std::string(1000, '3')), Malformed);
}
