// Jobs with several parts, or copies of one.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "host/spool/spool.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/mesh_files.hpp"
#include "tests/host/support/refusal.hpp"
#include "tests/host/support/sample_job.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;
using test::refusal;
using test::TempFolder;

/// A folder with a profile whose bed is 120 x 100 x 80 mm, and models.
struct Bench {
  Bench() {
    folder.write("bench.toml", test::sample_profile);
    folder.write("plate.svg", test::sample_drawing);
    folder.write("box.obj", test::box_obj({30, 20, 1}));
    folder.write("pin.obj", test::box_obj({4, 4, 3}));
  }
  std::filesystem::path job(const std::string& parts, const std::string& zones) const {
    return folder.write("job.toml", "printer = \"bench.toml\"\n" + parts + zones +
                                        "\n[mixture]\na = [1, 0, 0]\nb = [0, 1, 0]\n");
  }
  std::filesystem::path boxes(const std::string& keys) const {
    return job("[part]\nfile = \"box.obj\"\nlayer_height = 0.2\nbead_width = 1.0\n" + keys,
               "\n[[zone]]\nselect = \"box\"\nmixture = \"a\"\n");
  }
  std::filesystem::path two(const std::string& first, const std::string& second) const {
    return job(
        "[[part]]\nfile = \"box.obj\"\nlayer_height = 0.2\nbead_width = 1.0\n" + first +
            "\n[[part]]\nfile = \"pin.obj\"\n" + second,
        "\n[[zone]]\nselect = \"box\"\nmixture = \"a\"\n[[zone]]\nselect = \"pin\"\nmixture = \"b\"\n");
  }
  TempFolder folder;
};

}  // namespace

TEST_CASE("Copies are arranged side by side in the middle of the bed") {
  const Bench bench;
  const PreparedJob prepared = prepare(load_job(bench.boxes("copies = 4\ngap = 3.0")));
  const core::Layer layer = prepared.part->layer(0);
  REQUIRE(layer.islands.size() == 4);
  CHECK(prepared.part->extent().size() == core::Vec2(63, 43));
  CHECK(prepared.frame.extent.center().isApprox(core::Vec2(60, 50)));
}

TEST_CASE("More copies than fit are refused with the number that fits, and that does") {
  const Bench bench;
  const std::string sentence = refusal(bench.boxes("copies = 30"));
  CHECK_THAT(sentence, Contains("write copies = 12"));  // 3 columns, 4 rows
  CHECK(refusal(bench.boxes("copies = 12")).empty());
  CHECK_THAT(refusal(bench.boxes("copies = 13")), Contains("write copies = 12"));
  CHECK_THAT(refusal(bench.boxes("copies = 2.5")), Contains("whole number"));
}

TEST_CASE("Several parts have their own files, scales and copies, and share zones and settings") {
  const Bench bench;
  const Job job = load_job(bench.two("", "copies = 3\nscale = [1, 1, 2]"));
  const PreparedJob prepared = prepare(job);
  CHECK(prepared.part->layer_count() == 30);
  CHECK(prepared.part->layer(0).islands.size() == 4);
  CHECK(prepared.part->layer(20).islands.size() == 3);
  CHECK(prepared.part->layer(20).islands[0].zones[0].zone == 1);
  CHECK_THAT(refusal(bench.two("", "speed = 20")), Contains("part[1].speed") && Contains("first [[part]]"));
  CHECK_THAT(refusal(bench.two("place = \"as-is\"", "")), Contains("center"));
  CHECK_THAT(refusal(bench.two("", "colour = 1")), Contains("part[1].colour is not a known key"));
  CHECK_THAT(
      refusal(bench.job("[[part]]\nfile = \"box.obj\"\nlayer_height = 0.2\nbead_width = 1.0\ncopies = 2\n",
                        "[[zone]]\nselect = \"box\"\nmixture = \"a\"\n[[zone]]\nselect = \"lid\"\n"
                        "mixture = \"b\"\n")),
      Contains("select = \"lid\" matches nothing in any part"));
}

TEST_CASE("A kept print holds the models of all its parts") {
  const Bench bench;
  const Job job = load_job(bench.two("", ""));
  PrintOrder order;
  order.job_name = "job";
  const Spool spool = Spool::create(bench.folder / "spool", job, order);
  for (const char* model : {"box.obj", "pin.obj"}) std::filesystem::remove(bench.folder / model);
  CHECK(prepare(spool.job()).part->layer(0).islands.size() == 2);
}

TEST_CASE("A plate of copies takes as much plastic as they do one by one", "[optimised]") {
  const Bench bench;
  const auto volume = [&](const char* copies) {
    const auto report = bench.folder / "r.json";
    const test::Outcome outcome =
        test::run({"plan", bench.boxes(copies).string(), "-o", (bench.folder / "x.gcode").string(),
                   "--report", report.string()});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    return nlohmann::json::parse(test::read_text(report)).at("mixtures").at(0).at("part_mm3").get<double>();
  };
  CHECK(volume("copies = 3") == Approx(3 * volume("")).epsilon(0.01));
}

}  // namespace unicursal::host
