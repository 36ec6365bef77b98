#include "core/model/hanging.hpp"

#include <catch2/catch.hpp>

#include "core/model/inspect_model.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

/// At a bead width of 1 mm and layers of 0.5 mm.
HangingCheck checked(const Mesh& mesh) {
  const TempFolder folder;
  const auto p = part({folder.write("m.stl", binary_stl(mesh))}, {"m"}, 0.5);
  HangingCheck check(1);
  for (std::size_t i = 0; i < p->layer_count(); ++i) check.add(p->layer(i));
  return check;
}

std::vector<std::string> hanging(const Mesh& mesh) {
  return checked(mesh).sentences();
}

/// A pyramid that stands on its tip, which is a square of 2 mm; its sides lean out by so much for each mm.
Mesh leaning(double slope) {
  const double height = 10, low = 1, high = low + slope * height;
  Mesh mesh = box_mesh({-1, -1, 0}, {1, 1, 1});
  for (Triangle& triangle : mesh) {
    for (Vec3& corner : triangle) {
      corner.head<2>() *= corner.z() > 0 ? high : low;
      corner.z() *= height;
    }
  }
  return mesh;
}

const Mesh ground = box_mesh({0, 0, 0}, {20, 20, 3});

}  // namespace

TEST_CASE("an island with nothing below it is reported with layer, height and place") {
  const Mesh table =
      joined(joined(ground, box_mesh({0, 0, 3}, {5, 5, 12})), box_mesh({10, 10, 10}, {20, 20, 12}));
  const auto found = hanging(table);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Contains("100 mm² begins in the air in layer 20, at z = 10.00 mm near (15, 15)"));
}

TEST_CASE("a steep overhang is reported with its worst layer, place and area, a gentle one is not") {
  CHECK(hanging(ground).empty());
  CHECK(hanging(leaning(0.9)).empty());               // 42° from the vertical
  const auto leans = checked(leaning(1.6)).places();  // 58°
  REQUIRE(leans.size() == 1);
  CHECK(leans[0].kind == HangingPlace::Kind::overhang);
  CHECK(leans[0].layers == 19);
  CHECK(leans[0].layer == 19);
  // Half a bead is supported: of a step of 0.8 mm, 0.3 mm hang over, along 4 sides of 33 mm.
  CHECK(leans[0].area == Approx(4 * 0.3 * 33).epsilon(0.05));
  const auto shelf = checked(joined(ground, box_mesh({15, 15, 3}, {40, 40, 6}))).places();
  REQUIRE(shelf.size() == 1);
  CHECK(shelf[0].layer == 6);
  CHECK(shelf[0].layers == 1);
  CHECK(shelf[0].z == Approx(3));
  CHECK(shelf[0].area == Approx(25 * 25 - 5.5 * 5.5).epsilon(0.01));
  CHECK_THAT(hanging(joined(ground, box_mesh({15, 15, 3}, {40, 40, 6}))).at(0),
             Contains("mm² of layer 6 hang over, at z = 3.00 mm near (27.5, 27.5)"));
}

TEST_CASE("empty layers between others are reported once, those at the end not at all") {
  const auto found = hanging(joined(ground, box_mesh({0, 0, 5}, {20, 20, 7})));
  REQUIRE(found.size() == 2);
  CHECK_THAT(found[0], Contains("4 layers are empty from layer 6 on, at z = 3.00 mm"));
  CHECK_THAT(found[1], Contains("400 mm² begins in the air in layer 10, at z = 5.00 mm near (10, 10)"));
  HangingCheck check(1);
  Layer layer;
  layer.islands.push_back({{{{0, 0}, {9, 0}, {9, 9}}, {}}, {}});
  check.add(layer);
  check.add(Layer{});
  CHECK(check.sentences().empty());
}

TEST_CASE("many places in the air are counted, not listed") {
  Mesh drops = ground;
  for (int i = 0; i < 25; ++i) drops = joined(drops, box_mesh({4.0 * i, 30, 5.0 + i}, {4.0 * i + 2, 32, 40}));
  const auto found = hanging(joined(drops, box_mesh({0, 0, 3}, {1, 1, 40})));
  REQUIRE(found.size() == 11);
  CHECK_THAT(found.back(), Contains("15 more places"));
}

TEST_CASE("what a model holds is listed with areas or volumes") {
  const TempFolder folder;
  Mesh cavity = box_mesh({5, 5, 1}, {15, 15, 2});
  for (Triangle& triangle : cavity) turn_over(triangle);
  const auto file =
      folder.write("m.stl", binary_stl(joined(joined(ground, box_mesh({30, 0, 0}, {34, 4, 1})), cavity)));
  const ModelContents mesh = inspect_model({file});
  CHECK(mesh.bodies == 2);
  CHECK(mesh.size == Eigen::Vector3d(34, 20, 3));
  REQUIRE(mesh.zones.size() == 2);
  CHECK(mesh.zones[0].select == "body 1");
  CHECK(mesh.zones[0].amount == Approx(1200 - 100));
  CHECK(mesh.zones[1].amount == Approx(16));
  const ModelContents flat = inspect_model({folder.write(
      "d.svg", drawing("<path fill='red' fill-rule='evenodd' d='M0 0h20v20h-20zM5 5h10v10h-10z'/>"
                       "<rect x='15' width='10' height='10' fill='blue'/>"))});
  CHECK(flat.drawing);
  CHECK(flat.holes == 1);
  REQUIRE(flat.zones.size() == 2);
  CHECK(flat.zones[0].select == "#ff0000");
  CHECK(flat.zones[0].amount == Approx(300 - 50).epsilon(1e-3));
  CHECK(flat.zones[1].amount == Approx(100).epsilon(1e-3));
}

TEST_CASE("a file of very many solids is one body, and takes no more memory than its facets") {
  const TempFolder folder;
  Mesh crowd;
  for (int i = 0; i < 5000; ++i) {
    const double x = 2.0 * (i % 100), y = 2.0 * (i / 100);
    const Mesh one = box_mesh({x, y, 0}, {x + 1, y + 1, 1});
    crowd.insert(crowd.end(), one.begin(), one.end());
  }
  const ModelContents contents = inspect_model({folder.write("crowd.stl", binary_stl(crowd))});
  REQUIRE(contents.zones.size() == 1);
  CHECK(contents.zones[0].select == "crowd.stl");
  CHECK(contents.zones[0].amount == Approx(5000));
}

TEST_CASE("bodies of an STL file are zones by number, voids with the solid around them") {
  const TempFolder folder;
  Mesh cavity = box_mesh({5, 5, 1}, {15, 15, 2});
  for (Triangle& triangle : cavity) turn_over(triangle);
  const Mesh two = joined(joined(cavity, box_mesh({20, 0, 0}, {30, 20, 3})), ground);
  const auto file = folder.write("m.stl", binary_stl(two));
  const auto p = part({file}, {"body 1", "body 2"}, 0.5);
  const Layer low = p->layer(0), middle = p->layer(2);
  CHECK(zone_area(low, 0) == Approx(200).epsilon(1e-3));
  CHECK(zone_area(low, 1) == Approx(400).epsilon(1e-3));
  CHECK(zone_area(middle, 1) == Approx(300).epsilon(1e-3));
  CHECK(middle.islands.size() == 1);
  const auto rest = part({file}, {"m.stl", "m:body 1"}, 0.5);
  CHECK(zone_area(rest->layer(0), 0) == Approx(400).epsilon(1e-3));
}

TEST_CASE("thousands of shells that face inwards are turned, or are voids", "[optimised]") {
  const TempFolder folder;
  // 40 x 40 voids in one block, and as many bodies beside it that are inside out.
  Mesh mesh = box_mesh({0, 0, 0}, {200, 200, 10});
  for (int i = 0; i < 1600; ++i) {
    const double x = 2.0 * (i % 40) + 10, y = 2.0 * (i / 40) + 10;
    for (Triangle triangle : box_mesh({x, y, 4}, {x + 1, y + 1, 6})) {
      turn_over(triangle);
      mesh.push_back(triangle);
      for (Vec3& corner : triangle) corner.x() += 300;
      mesh.push_back(triangle);
    }
  }
  const auto file = folder.write("voids.stl", binary_stl(mesh));
  const auto p = part({file}, {"voids"}, 1.0);
  CHECK(outline_area(p->layer(2)) == Approx(200 * 200).epsilon(1e-3));
  CHECK(outline_area(p->layer(4)) == Approx(200 * 200).epsilon(1e-3));  // minus 1600 voids, plus 1600 bodies
  CHECK_THAT(p->warnings().at(0), Contains("1600 shells were inside out"));
}
