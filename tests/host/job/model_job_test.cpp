#include "host/job/model_job.hpp"

#include <catch2/catch.hpp>

#include "core/model/read_part.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/mesh_files.hpp"
#include "tests/host/support/refusal.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;
using test::refusal;
using test::replaced;
using test::TempFolder;

std::string box(double x, int first) {
  return test::box_obj({10, 10, 3}, x, first);
}

}  // namespace

TEST_CASE("A job that is written for a model loads, with one zone for each colour or body") {
  const TempFolder folder;
  const Profile profile = load_profile(folder.write("bench.toml", test::sample_profile));
  const auto load = [&](const std::filesystem::path& model) {
    const ModelJob written = model_job({model}, profile, folder.path());
    INFO(written.text);
    const Job job = load_job(folder.write("job.toml", written.text));
    CHECK(job.profile.printer.name == "Test bench");
    CHECK_FALSE(prepare(job).part->layer(0).islands.empty());
    return job;
  };
  const Job drawing = load(folder.write("plate.svg", test::sample_drawing));
  REQUIRE(drawing.source.zones.size() == 2);
  CHECK(drawing.source.zones[0].select == "#0000ff");
  CHECK(drawing.source.layer_height == Approx(0.3));
  CHECK(drawing.bead_width == Approx(0.75));
  CHECK(drawing.source.height == Approx(1.5));
  CHECK(load(folder.write("one.obj", box(0, 1))).source.zones.at(0).select == "one.obj");
  const Job named = load(folder.write("two.obj", "o left\n" + box(0, 1) + "o the \"right\"\n" + box(10, 9)));
  REQUIRE(named.source.zones.size() == 2);
  CHECK(named.source.zones[1].select == "the \"right\"");
  CHECK(named.print.materials[0].mixture.share(0) == 1);
  CHECK(named.print.materials[1].mixture.share(1) == 1);
  folder.write("red.mtl", "newmtl r\nKd 0.84 0.2 0.19\nnewmtl b\nKd 0.15 0.38 0.77\n");
  const Job coloured = load(
      folder.write("c.obj", "mtllib red.mtl\no a\nusemtl r\n" + box(0, 1) + "o b\nusemtl b\n" + box(10, 9)));
  // The filaments that pictures show are blue, red and white.
  CHECK(coloured.print.materials[0].mixture.share(1) > 0.9);
  CHECK(coloured.print.materials[1].mixture.share(0) > 0.9);
}

TEST_CASE("A job for a drawing with a gradient mixes from its first to its last colour where they lie") {
  const TempFolder folder;
  const Profile profile = load_profile(folder.write("bench.toml", test::sample_profile));
  const auto zone_of = [&](const std::string& gradient) {
    const auto model = folder.write(
        "sky.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 20' width='40mm' height='20mm'>" +
                       gradient + "<rect x='10' width='20' height='20' fill='url(#sky)'/></svg>");
    const ModelJob written = model_job({model}, profile, folder.path());
    INFO(written.text);
    const Job job = load_job(folder.write("job.toml", written.text));
    CHECK_FALSE(prepare(job).part->layer(0).islands.empty());
    REQUIRE(job.print.materials.size() == 1);
    return job.print.materials.front();
  };
  const std::string stops =
      "<stop offset='0' stop-color='#0000ff'/><stop offset='1' stop-color='#ff0000'/></linearGradient>";
  // The filaments that pictures show are blue, red and white.
  const auto plain = zone_of("<linearGradient id='sky'>" + stops);
  REQUIRE(plain.gradient);
  CHECK(plain.mixture.share(0) > 0.7);
  CHECK(plain.gradient->to.share(1) > 0.7);
  CHECK(plain.gradient->along == std::array{1.0, 0.0, 0.0});
  CHECK(plain.gradient->begin == Approx(10));
  CHECK(plain.gradient->end == Approx(30));
  // From 5 to 15 mm below the upper edge: y points upwards in the part's frame.
  const auto down = zone_of(
      "<linearGradient id='sky' gradientUnits='userSpaceOnUse' x1='0' x2='0' y1='0' y2='20'>"
      "<stop offset='.25' stop-color='#ff0000'/><stop offset='.5' stop-color='#fff'/>"
      "<stop offset='.75' stop-color='#0000ff'/></linearGradient>");
  REQUIRE(down.gradient);
  CHECK(down.gradient->along[1] == Approx(-1));
  CHECK(down.gradient->begin == Approx(-15));
  CHECK(down.gradient->end == Approx(-5));
  CHECK(down.mixture.share(1) > 0.9);
  // A hard edge cannot be a gradient: one mixture.
  CHECK_FALSE(zone_of("<linearGradient id='sky'><stop offset='.5' stop-color='#f00'/><stop offset='.5' "
                      "stop-color='#00f'/></linearGradient>")
                  .gradient);
}

TEST_CASE("A model is loaded like a job") {
  const TempFolder folder;
  const auto profile = folder.write("bench.toml", test::sample_profile);
  folder.write("red.mtl", "newmtl r\nKd 1 0 0\n");
  const auto model = folder.write("one.obj", "mtllib red.mtl\nusemtl r\n" + box(0, 1));
  const Job job = load_job_or_model(model, profile, UnnamedPrinter::refuse);
  CHECK(job.source.zones.at(0).select == "#ff0000");
  CHECK_FALSE(prepare(job).part->layer(0).islands.empty());
  CHECK_THROWS_WITH(load_job(model), Contains("unicursal new"));
}

TEST_CASE("A key that resembles none is refused with the keys that there are") {
  const TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  const auto job = folder.write("job.toml", replaced(test::sample_job, "flow = 3.0", "colour = 3"));
  CHECK_THAT(refusal(job), Contains("the keys here are file, copies") && !Contains("did you mean"));
}

}  // namespace unicursal::host
