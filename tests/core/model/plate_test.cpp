// Several parts and copies on one plate.
#include "core/model/plate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/numeric/random.hpp"
#include "model_support.hpp"

namespace unicursal::core {
namespace {

bool apart(const Vec2& a, const Vec2& size_a, const Vec2& b, const Vec2& size_b, double gap) {
  constexpr double rounding = 1e-9;
  return a.x() + size_a.x() + gap <= b.x() + rounding || b.x() + size_b.x() + gap <= a.x() + rounding ||
         a.y() + size_a.y() + gap <= b.y() + rounding || b.y() + size_b.y() + gap <= a.y() + rounding;
}

}  // namespace

TEST_CASE("rectangles are arranged on the bed, apart from each other") {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec2> sizes;
    for (int i = 0; i < 1 + round % 12; ++i)
      sizes.emplace_back(5 + 30 * random.uniform(), 5 + 30 * random.uniform());
    const auto corners = arranged(sizes, {200, 180}, 5);
    REQUIRE(corners);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      CHECK((*corners)[i].minCoeff() >= 0);
      CHECK((*corners)[i].x() + sizes[i].x() <= 200);
      CHECK((*corners)[i].y() + sizes[i].y() <= 180);
      for (std::size_t k = 0; k < i; ++k) CHECK(apart((*corners)[i], sizes[i], (*corners)[k], sizes[k], 5));
    }
  }
  // Nine squares lie in a square, not in a row.
  const auto nine = arranged(std::vector<Vec2>(9, Vec2(20, 20)), {200, 200}, 5);
  REQUIRE(nine);
  CHECK(std::all_of(nine->begin(), nine->end(), [](const Vec2& corner) { return corner.maxCoeff() <= 50; }));
  CHECK(arranged(std::vector<Vec2>(9, Vec2(20, 20)), {70, 200}, 5));
  CHECK_FALSE(arranged(std::vector<Vec2>(9, Vec2(20, 20)), {69, 69}, 5));
  CHECK_FALSE(arranged({Vec2(201, 1)}, {200, 200}, 5));
}

TEST_CASE("a plate has the islands of all its parts, each at its place, and is as high as the highest") {
  const TempFolder folder;
  const auto read = [&](const char* name, const Vec3& size) {
    const auto file = folder.write(name, binary_stl(box_mesh({0, 0, 0}, size)));
    PartSource source{{file}, 0, 0.5, zones({"low.stl", "high.stl"})};
    std::vector<bool> matched(2, false);
    std::shared_ptr<const Part> part = read_part(source, {}, &matched);
    CHECK(matched[name[0] == 'h' ? 1 : 0]);
    CHECK_FALSE(matched[name[0] == 'h' ? 0 : 1]);
    return part;
  };
  const auto low = read("low.stl", {10, 10, 2}), high = read("high.stl", {5, 5, 4});
  const auto plate = plate_of({{low, {0, 0}}, {low, {20, 0}}, {high, {50, 7}}});
  CHECK(plate->layer_count() == 8);
  CHECK(plate->height() == Approx(4));
  CHECK(plate->extent().min == Vec2(0, 0));
  CHECK(plate->extent().max == Vec2(55, 12));
  const Layer bottom = plate->layer(0), top = plate->layer(7);
  REQUIRE(bottom.islands.size() == 3);
  CHECK(zone_area(bottom, 0) == Approx(200));
  CHECK(zone_area(bottom, 1) == Approx(25));
  CHECK(area(bottom.islands[2].outline) == Approx(25));  // largest first
  CHECK(bounds(bottom.islands[1].outline).min == Vec2(20, 0));
  CHECK(bounds(bottom.islands[2].zones[0].polygons).min == Vec2(50, 7));
  REQUIRE(top.islands.size() == 1);
  CHECK(top.index == 7);
  CHECK(top.top == Approx(4));
  CHECK(top.height == Approx(0.5));
}

TEST_CASE("parts that are printed in turn each begin on the bed") {
  const TempFolder folder;
  const auto read = [&](const char* name, double height) -> std::shared_ptr<const Part> {
    PartSource source{
        {folder.write(name, binary_stl(box_mesh({0, 0, 0}, {10, 10, height})))}, 0, 0.5, zones({name})};
    return read_part(source, {});
  };
  const auto low = read("low.stl", 2), high = read("high.stl", 3);
  const auto plate = plate_in_turn({{low, {0, 0}}, {low, {20, 0}}, {high, {40, 5}}});
  REQUIRE(plate->layer_count() == 4 + 4 + 6);
  CHECK(plate->height() == Approx(3));
  CHECK(plate->extent().max == Vec2(50, 15));
  const std::vector<double> tops{0.5, 1, 1.5, 2, 0.5, 1, 1.5, 2, 0.5, 1, 1.5, 2, 2.5, 3};
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const Layer layer = plate->layer(i);
    CHECK(layer.index == i);
    CHECK(layer.top == Approx(tops[i]));
    CHECK(rests_on_bed(layer) == (tops[i] == 0.5));
    REQUIRE(layer.islands.size() == 1);
    CHECK(bounds(layer.islands[0].outline).min == (i < 4 ? Vec2(0, 0) : i < 8 ? Vec2(20, 0) : Vec2(40, 5)));
  }
}

}  // namespace unicursal::core
