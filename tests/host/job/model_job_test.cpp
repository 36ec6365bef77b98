#include "host/job/model_job.hpp"

#include <catch2/catch.hpp>

#include "core/model/read_part.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/mesh_files.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;
using test::replaced;
using test::TempFolder;

std::string box(double x, int first) {
  return test::box_obj({10, 10, 3}, x, first);
}

std::string refusal(const std::filesystem::path& job) {
  try {
    prepare(load_job(job));
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
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
  CHECK(coloured.print.materials[0].mixture.share(1) == 1);
  CHECK(coloured.print.materials[1].mixture.share(0) == 1);
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
