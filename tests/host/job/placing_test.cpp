// The keys that turn, mirror and scale a part, and what is said of one that does not fit.
#include <catch2/catch.hpp>
#include <cctype>

#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/mesh_files.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;
using test::box_obj;
using test::replaced;
using test::TempFolder;

/// A folder with a profile whose bed is 120 x 100 x 80 mm, and jobs in it.
struct Bench {
  Bench() {
    folder.write("bench.toml", test::sample_profile);
    folder.write("plate.svg", test::sample_drawing);
  }
  Job load(const std::string& file, const std::string& select, const std::string& keys) const {
    return load_job(folder.write("job.toml", "printer = \"bench.toml\"\n[part]\nfile = \"" + file +
                                                 "\"\nlayer_height = 0.2\nbead_width = 1.0\n" + keys +
                                                 "\n[[zone]]\nselect = \"" + select +
                                                 "\"\nmixture = \"a\"\n[mixture]\na = [1, 0, 0]\n"));
  }
  Job box(const std::string& keys) const { return load("box.obj", "box", keys); }
  Job drawing(const std::string& keys) const { return load("plate.svg", "plate", "height = 0.4\n" + keys); }
  TempFolder folder;
};

Eigen::Vector3d size_of(const Job& job) {
  const PreparedJob prepared = prepare(job);
  const core::Vec2 size = prepared.part->extent().size();
  return {size.x(), size.y(), prepared.part->height()};
}

template <class Load>
std::string refusal(Load load) {
  try {
    prepare(load());
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A part is measured in its unit, scaled, mirrored, laid down and turned") {
  const Bench bench;
  bench.folder.write("box.obj", box_obj({10, 10, 3}));
  CHECK(size_of(bench.box("")).isApprox(Eigen::Vector3d(10, 10, 3)));
  CHECK(size_of(bench.box("units = \"inch\"\nscale = 0.1")).isApprox(Eigen::Vector3d(25.4, 25.4, 7.6)));
  CHECK(size_of(bench.box("scale = [2, 3, 1]\nrotate = 90")).isApprox(Eigen::Vector3d(30, 20, 3)));
  CHECK(size_of(bench.box("rotate = [90, 0, 0]")).isApprox(Eigen::Vector3d(10, 3, 10)));
  CHECK(size_of(bench.box("rotate = [0, 90, 0]")).isApprox(Eigen::Vector3d(3, 10, 10)));
  CHECK(size_of(bench.box("scale = [1, 1, 5]\nlie_on = \"largest-face\""))
            .isApprox(Eigen::Vector3d(10, 15, 10)));
  const PreparedJob mirrored = prepare(bench.box("mirror = \"x\""));
  CHECK(mirrored.part->extent().min.x() == Approx(-10));
  CHECK(mirrored.part->layer(0).islands.size() == 1);
  CHECK(mirrored.part->warnings().empty());
  CHECK(size_of(bench.drawing("width = 50")).isApprox(Eigen::Vector3d(50, 40, 0.4)));
  CHECK(size_of(bench.drawing("rotate = 90\nwidth = 50")).isApprox(Eigen::Vector3d(50, 62.5, 0.4)));
  CHECK(bench.box("").shaping.paint_depth == 2);
  CHECK(bench.box("paint_depth = 0.7").shaping.paint_depth == 0.7);
}

TEST_CASE("Keys that do not suit the file are refused with the key that does") {
  const Bench bench;
  bench.folder.write("box.obj", box_obj({10, 10, 3}));
  CHECK_THAT(refusal([&] { return bench.drawing("units = \"inch\""); }), Contains("scale = 25.4"));
  CHECK_THAT(refusal([&] { return bench.drawing("rotate = [90, 0, 0]"); }), Contains("flat"));
  CHECK_THAT(refusal([&] { return bench.drawing("lie_on = \"largest-face\""); }), Contains("flat"));
  CHECK_THAT(refusal([&] { return bench.drawing("mirror = \"z\""); }), Contains("flat"));
  CHECK_THAT(refusal([&] { return bench.drawing("scale = [1, 1, 2]"); }), Contains("set height"));
  CHECK_THAT(refusal([&] { return bench.box("width = 5"); }), Contains("only for drawings"));
  CHECK_THAT(refusal([&] { return bench.box("units = \"inches\""); }), Contains("did you mean \"inch\"?"));
  CHECK_THAT(refusal([&] { return bench.box("rotate = [1, 2]"); }), Contains("2 numbers instead of 3"));
  CHECK_THAT(refusal([&] { return bench.box("scale = 0"); }), Contains("part.scale"));
}

TEST_CASE("A part that is too large is refused with what makes it fit, and that does") {
  const Bench bench;
  struct Case {
    std::array<double, 3> size;
    const char* keys;
    const char* remedy;  // what follows "write "
  };
  for (const auto& [size, keys, remedy] : {
           Case{{20, 110, 10}, "", "rotate = 90"},
           Case{{130, 10, 3}, "", "rotate = 45"},
           Case{{20, 10, 90}, "", "rotate = [90, 0, 0]"},
           Case{{3, 110, 85}, "", "rotate = [0, 90, 90]"},
           Case{{140, 75, 10}, "", "scale = 0.857"},
           Case{{240, 10, 3}, "", "scale = 0.5"},
           Case{{240, 10, 3}, "scale = 2", "make the part 0.25 times as large"},
           Case{{20000, 9000, 5000}, "", "units = \"micron\""},
       }) {
    bench.folder.write("box.obj", box_obj(size));
    const std::string sentence = refusal([&, keys = keys] { return bench.box(keys); });
    INFO(sentence);
    CHECK_THAT(sentence, Contains(remedy));
    if (std::string_view(remedy).starts_with("make")) continue;
    CHECK(refusal([&, remedy = remedy] { return bench.box(remedy); }).empty());
  }
  bench.folder.write("box.obj", box_obj({140, 75, 10}));
  CHECK_THAT(refusal([&] { return bench.box(""); }), Contains("or rotate = [90, 0, 40] to stand it up"));
  CHECK_THAT(refusal([&] { return bench.drawing("width = 300"); }), Contains("write width = 120.0"));
}

TEST_CASE("The unit of a part that is too small is suspected, also if it is refused") {
  const Bench bench;
  bench.folder.write("box.obj", box_obj({0.8, 0.8, 0.1}));
  std::vector<std::string> notes;
  const auto note = [&](const std::string& sentence) { notes.push_back(sentence); };
  prepare(bench.box(""), std::nullopt, note);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("units = \"inch\"") && Contains("makes 20.32 x 20.32 x 2.54 mm"));
  notes.clear();
  CHECK_THROWS(prepare(bench.box("place = [-5, -5]"), std::nullopt, note));
  CHECK(notes.size() == 1);
  notes.clear();
  prepare(bench.box("units = \"inch\""), std::nullopt, note);
  CHECK(notes.empty());
}

}  // namespace unicursal::host
