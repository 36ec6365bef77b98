#include <catch2/catch.hpp>
#include <future>

#include "core/error.hpp"
#include "core/model/read_part.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& selects,
                    double layer_height = 0.2) {
  try {
    part(files, selects, layer_height);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a cube of 20 mm has 100 layers of 400 mm²") {
  const auto cube = part({test_data("cube20.stl")}, {"cube20.stl"});
  REQUIRE(cube->layer_count() == 100);
  CHECK(cube->height() == Approx(20));
  CHECK(cube->extent().size() == Vec2(20, 20));
  for (const std::size_t i : {0u, 1u, 50u, 99u}) {
    const Layer layer = cube->layer(i);
    CHECK(layer.z == Approx(0.2 * double(i) + 0.1));
    REQUIRE(layer.islands.size() == 1);
    CHECK(area(layer.islands[0].outline) == Approx(400));
    CHECK(zone_area(layer, 0) == Approx(400));
  }
}

TEST_CASE("layers are those whose middle lies below the top, wherever the mesh stands") {
  const TempFolder folder;
  const auto layers = [&](double height) {
    const auto file = folder.write("box.stl", binary_stl(box_mesh({0, 0, -7}, {9, 9, -7 + height})));
    const auto p = part({file}, {"box"}, 0.25);
    CHECK_FALSE(p->layer(p->layer_count() - 1).islands.empty());
    return p->layer_count();
  };
  CHECK(layers(1.0) == 4);
  CHECK(layers(1.12) == 4);
  CHECK(layers(1.13) == 5);
  CHECK(layers(0.03) == 1);
}

TEST_CASE("a first layer of its own height lifts the others") {
  PartSource source;
  source.files = {test_data("cube20.stl")};
  source.layer_height = 0.2;
  source.first_layer_height = 0.3;
  source.zones = {{"cube20.stl", {}, 0}};
  const auto cube = read_part(source);
  const Layer first = cube->layer(0), second = cube->layer(1);
  CHECK(first.height == Approx(0.3));
  CHECK(first.top == Approx(0.3));
  CHECK(first.z == Approx(0.15));
  CHECK(second.height == Approx(0.2));
  CHECK(second.top == Approx(0.5));
  CHECK(second.z == Approx(0.4));
  // 0.3 + 98 · 0.2 = 19.9, and the middle of one more, 20.0, is not below the top
  CHECK(cube->layer_count() == 99);
  CHECK(cube->height() == Approx(19.9));
  source.first_layer_height = 0.25;
  CHECK(read_part(source)->layer_count() == 100);
  source.first_layer_height = 30;
  CHECK(read_part(source)->layer_count() == 1);
  source.first_layer_height = -1;
  CHECK_THROWS_WITH(read_part(source), Catch::Contains("first_layer_height"));
}

TEST_CASE("a torus gives a ring with a hole") {
  const TempFolder folder;
  const auto p = part({folder.write("torus.stl", binary_stl(torus_mesh(10, 3, 96, 48)))}, {"torus"}, 0.2);
  const Layer middle = p->layer(p->layer_count() / 2);
  REQUIRE(middle.islands.size() == 1);
  CHECK(middle.islands[0].outline.holes.size() == 1);
  const double half_width = std::sqrt(9 - std::pow(middle.z - 3, 2));
  CHECK(area(middle.islands[0].outline) == Approx(4 * std::numbers::pi * 10 * half_width).epsilon(5e-3));
}

TEST_CASE("two solids that nearly touch become one island of two zones") {
  const TempFolder folder;
  const double gap = GENERATE(0.0, 0.002, 0.008, -0.004);
  CAPTURE(gap);
  const auto left = folder.write("left.stl", binary_stl(box_mesh({0, 0, 0}, {20, 40, 2})));
  const auto right = folder.write("right.stl", binary_stl(box_mesh({20 + gap, 0, 0}, {40, 40, 2})));
  const Layer layer = part({left, right}, {"left.stl", "right.stl"})->layer(3);
  REQUIRE(layer.islands.size() == 1);
  REQUIRE(layer.islands[0].zones.size() == 2);
  CHECK(zone_area(layer, 0) + zone_area(layer, 1) == Approx(area(layer.islands[0].outline)).epsilon(1e-6));
  CHECK(area(layer.islands[0].outline) == Approx(1600).epsilon(1e-5));
  CHECK(zone_area(layer, 0) == Approx(800).epsilon(1e-3));
}

TEST_CASE("solids apart stay apart, and a layer may have a gap") {
  const TempFolder folder;
  const Mesh low = box_mesh({0, 0, 0}, {5, 5, 1}), high = box_mesh({0, 0, 3}, {5, 5, 4});
  const auto p = part({folder.write("two.stl", binary_stl(joined(low, high)))}, {"two"}, 0.5);
  REQUIRE(p->layer_count() == 8);
  CHECK(p->layer(1).islands.size() == 1);
  CHECK(p->layer(3).islands.empty());
  CHECK(p->layer(7).islands.size() == 1);
}

TEST_CASE("where files overlap the later one covers the earlier") {
  const TempFolder folder;
  const auto ground = folder.write("ground.stl", binary_stl(box_mesh({0, 0, 0}, {20, 20, 2})));
  const auto inlay = folder.write("inlay.stl", binary_stl(box_mesh({5, 5, 1}, {15, 15, 2})));
  const auto p = part({ground, inlay}, {"ground", "inlay"});
  CHECK(zone_area(p->layer(0), 1) == 0);
  CHECK(zone_area(p->layer(9), 0) == Approx(300));
  CHECK(zone_area(p->layer(9), 1) == Approx(100));
}

TEST_CASE("a cavity is not printed") {
  const TempFolder folder;
  Mesh cavity = box_mesh({5, 5, 5}, {15, 15, 15});
  for (Triangle& triangle : cavity) turn_over(triangle);
  const auto file = folder.write("hollow.stl", binary_stl(joined(box_mesh({0, 0, 0}, {20, 20, 20}), cavity)));
  const auto p = part({file}, {"hollow"}, 1.0);
  CHECK(outline_area(p->layer(2)) == Approx(400));
  CHECK(outline_area(p->layer(10)) == Approx(300));
}

TEST_CASE("layers are the same from several threads") {
  const TempFolder folder;
  const auto p = part({folder.write("torus.stl", binary_stl(torus_mesh(10, 3, 64, 32)))}, {"torus"});
  std::vector<std::future<double>> areas;
  for (std::size_t i = 0; i < p->layer_count(); ++i) {
    areas.push_back(std::async(std::launch::async, [&p, i] { return outline_area(p->layer(i)); }));
  }
  for (std::size_t i = 0; i < p->layer_count(); ++i) CHECK(areas[i].get() == outline_area(p->layer(i)));
}

TEST_CASE("a mesh that lacks its lid is printed, with a note") {
  const auto p = part({test_data("open.stl")}, {"open"}, 1.0);
  for (const std::size_t i : {0u, 10u, 19u}) CHECK(outline_area(p->layer(i)) == Approx(400));
  CHECK_THAT(p->warnings().at(0), Contains("closed, the largest of"));
}

TEST_CASE("a part that is too small for a bead is suspected to be in another unit") {
  const TempFolder folder;
  const auto said = [&](double size) {
    const auto file = folder.write("box.stl", binary_stl(box_mesh({0, 0, 0}, {size, size, size / 2})));
    const auto p = part({file}, {"box"}, 0.002);
    return p->warnings().empty() ? std::string() : p->warnings().front();
  };
  CHECK_THAT(said(0.7874), Contains("in inches") && Contains("20 x 20 x 10 mm"));
  CHECK_THAT(said(0.02), Contains("in metres") && Contains("20 x 20 x 10 mm"));
  CHECK(said(3).empty());
}

TEST_CASE("a solid inside a solid of the same file does not hollow it") {
  const TempFolder folder;
  const Mesh both = joined(box_mesh({0, 0, 0}, {20, 20, 3}), box_mesh({5, 5, 0}, {15, 15, 3}));
  const auto p = part({folder.write("both.stl", binary_stl(both))}, {"both"}, 0.3);
  for (const std::size_t i : {0u, 5u, 9u}) CHECK(outline_area(p->layer(i)) == Approx(400));
}

TEST_CASE("bodies of one file may touch or overlap") {
  const TempFolder folder;
  const double low = GENERATE(10.0, 10.00001, 5.0);
  CAPTURE(low);
  // The second body's facets use the other diagonals.
  Mesh mirrored = box_mesh({low, -10, 0}, {20, 0, 3});
  for (Triangle& triangle : mirrored) {
    for (Vec3& corner : triangle) corner.y() = -corner.y();
    turn_over(triangle);
  }
  const auto file = folder.write("two.stl", binary_stl(joined(box_mesh({0, 0, 0}, {10, 10, 3}), mirrored)));
  const Layer layer = part({file}, {"two"}, 0.3)->layer(4);
  REQUIRE(layer.islands.size() == 1);
  CHECK(outline_area(layer) == Approx(200).epsilon(1e-4));
}

TEST_CASE("zones and files must match one to one") {
  const auto cube = test_data("cube20.stl");
  CHECK_THAT(refusal({cube}, {"cube.stl"}), Contains("cube.stl") && Contains("cube20.stl"));
  CHECK_THAT(refusal({cube}, {"cube20", "cube20.stl"}), Contains("already selected"));
  const TempFolder folder;
  const auto other = folder.write("other.stl", binary_stl(box_mesh({0, 0, 0}, {1, 1, 1})));
  CHECK_THAT(refusal({cube, other}, {"cube20"}),
             Contains("no zone selects this file") && Contains("other.stl"));
}

TEST_CASE("unprintable meshes are refused with a sentence") {
  Mesh sheet;
  add_quad(sheet, {0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0});
  const TempFolder folder;
  CHECK_THAT(refusal({folder.write("sheet.stl", binary_stl(sheet))}, {"sheet"}),
             Contains("sheet.stl") && Contains("encloses no volume"));
  CHECK_THAT(refusal({test_data("nan.stl")}, {"nan"}), Contains("triangle 3, vertex 1"));
  CHECK_THAT(refusal({test_data("cube20.stl")}, {"cube20"}, 0), Contains("layer_height"));
  CHECK_THROWS_AS(part({"none.stl"}, {"none"}), FileError);
}
