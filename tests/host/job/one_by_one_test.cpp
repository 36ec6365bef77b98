// Parts that are printed one after the other.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/model/hanging.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/mesh_files.hpp"
#include "tests/host/support/sample_job.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;

/// Boxes of 12 x 10 x 3 mm, and a pin of 6 x 6 x 5 mm, on a bed of 120 x 100 x 80 mm.
struct OneByOne {
  explicit OneByOne(const std::string& clearance = "clearance_radius = 18\nclearance_height = 4\n") {
    folder.write("bench.toml",
                 test::replaced(test::sample_profile, "[extruder]", clearance + "\n[extruder]"));
    folder.write("box.obj", test::box_obj({12, 10, 3}));
    folder.write("pin.obj", test::box_obj({6, 6, 5}));
  }
  std::filesystem::path job(const std::string& first, const std::string& second = "") const {
    return folder.write("job.toml",
                        "printer = \"bench.toml\"\n[[part]]\nfile = \"box.obj\"\nlayer_height = 0.25\n"
                        "bead_width = 1.0\norder = \"one-by-one\"\n" +
                            first + "\n[[part]]\nfile = \"pin.obj\"\n" + second +
                            "\n[[zone]]\nselect = \"box\"\nmixture = \"a\"\n[[zone]]\nselect = \"pin\"\n"
                            "mixture = \"b\"\n[mixture]\na = [1, 0, 0]\nb = [0, 1, 0]\n");
  }
  std::string refused(const std::string& first, const std::string& second = "",
                      const std::optional<LayerRange>& layers = {}) const {
    try {
      prepare(load_job(job(first, second)), layers);
    } catch (const core::DataError& error) {
      return error.what();
    }
    return "";
  }
  test::TempFolder folder;
};

}  // namespace

TEST_CASE("One by one, the layers of a part follow each other, and the highest part comes last") {
  const OneByOne bench;
  const PreparedJob prepared = prepare(load_job(bench.job("copies = 2")));
  CHECK(prepared.count == 12 + 12 + 20);
  core::HangingCheck hanging(1);
  std::size_t parts = 0;
  core::Box part;
  std::vector<core::Box> places;
  for (std::size_t i = 0; i < prepared.count; ++i) {
    const core::Layer layer = prepared.part->layer(i);
    CHECK(layer.index == i);
    REQUIRE(layer.islands.size() == 1);
    CHECK(layer.islands[0].zones[0].zone == (i < 24 ? 0 : 1));
    hanging.add(layer);
    const core::Box here = core::bounds(layer.islands[0].outline);
    if (core::rests_on_bed(layer)) ++parts, part = here, places.push_back(here);
    CHECK(here.min.isApprox(part.min));
  }
  CHECK(parts == 3);
  CHECK(hanging.places().empty());  // a part that begins on the bed does not begin in the air
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const core::Vec2 apart = (places[a].min - places[b].max).cwiseMax(places[b].min - places[a].max);
      CHECK(apart.maxCoeff() >= 18 - 1e-9);
    }
  }
  CHECK(prepared.frame.part_height == Approx(5));
}

TEST_CASE("Parts that the head would strike are refused with what to do, before anything is heated") {
  CHECK(OneByOne().refused("").empty());
  CHECK_THAT(OneByOne("").refused(""),
             Contains("part.order") && Contains("clearance_radius and clearance_height"));
  CHECK_THAT(OneByOne("clearance_radius = 18\n").refused(""), Contains("clearance_height"));
  CHECK_THAT(OneByOne("clearance_radius = 18\nclearance_height = 2\n").refused(""),
             Contains("a part of 3.0 mm would be struck") && Contains("clearance_height of 2 mm"));
  CHECK_THAT(OneByOne().refused("", "copies = 2"), Contains("a part of 5.0 mm would be struck"));
  CHECK_THAT(OneByOne("clearance_radius = 110\nclearance_height = 9\n").refused(""),
             Contains("does not fit") && Contains("110.0 mm apart") && Contains("order = \"together\""));
  CHECK_THAT(OneByOne().refused("", "", LayerRange{0, 3}), Contains("--layers") && Contains("together"));
}

TEST_CASE("The skirt of the first part keeps off the place of the next") {
  const OneByOne bench;
  const PreparedJob prepared = prepare(load_job(bench.job("skirt = { loops = 2, distance = 25 }")));
  const core::Box first = core::bounds(prepared.part->layer(0).islands[0].outline),
                  second = core::bounds(prepared.part->layer(12).islands[0].outline);
  CHECK((second.min - first.max).cwiseMax(first.min - second.max).maxCoeff() > 27);
}

TEST_CASE("The simulated printer sees no strike while parts are printed one by one, and all are laid whole") {
  const OneByOne bench;
  const auto report = bench.folder / "r.json";
  const test::Outcome outcome = test::run(
      {"dry-run", bench.job("copies = 2\nfirst_layer_speed = 0.5").string(), "--report", report.string()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const nlohmann::json seen = nlohmann::json::parse(test::read_text(report));
  CHECK(seen["simulator"]["struck"]["by_nozzle"] == 0);
  CHECK(seen["simulator"]["struck"]["by_head"] == 0);
  CHECK(seen["simulator"]["layers"].size() == 44);
  CHECK(seen["laid"]["layers"].size() == 44);
  CHECK(seen["laid"]["total"]["outside_mm3"].get<double>() < 0.1);
  CHECK(seen["laid"]["total"]["gap_fraction"].get<double>() < 0.05);
  CHECK(seen["laid"]["total"]["area_mm2"].get<double>() == Approx(24 * 120 + 20 * 36).epsilon(0.02));
}

}  // namespace unicursal::host
