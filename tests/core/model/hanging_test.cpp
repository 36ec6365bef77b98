#include "core/model/hanging.hpp"

#include <catch2/catch.hpp>

#include "core/model/inspect_model.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> hanging(const Mesh& mesh) {
  const TempFolder folder;
  const auto p = part({folder.write("m.stl", binary_stl(mesh))}, {"m"}, 0.5);
  HangingCheck check;
  for (std::size_t i = 0; i < p->layer_count(); ++i) check.add(p->layer(i));
  return check.sentences();
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

TEST_CASE("islands that rest on something, however little, are not reported") {
  CHECK(hanging(ground).empty());
  CHECK(hanging(joined(ground, box_mesh({15, 15, 3}, {40, 40, 6}))).empty());
  CHECK(hanging(torus_mesh(10, 3, 48, 24)).empty());
}

TEST_CASE("empty layers between others are reported once, those at the end not at all") {
  const auto found = hanging(joined(ground, box_mesh({0, 0, 5}, {20, 20, 7})));
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0],
             Contains("4 layers are empty from layer 6 on, at z = 3.00 mm") && Contains("z = 5.00 mm"));
  HangingCheck check;
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
