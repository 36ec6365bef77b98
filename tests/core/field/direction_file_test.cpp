#include "core/field/direction_file.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "core/field/make_direction_field.hpp"
#include "tests/core/support/shapes.hpp"

using namespace unicursal::core;
using namespace unicursal::core::test;
namespace fs = std::filesystem;

namespace {

constexpr double one_degree = std::numbers::pi / 180;

/// A file that is removed at the end of its scope.
class TextFile {
 public:
  explicit TextFile(const std::string& text) {
    static int number = 0;
    path_ = fs::temp_directory_path() /
            ("unicursal-field-" + std::to_string(::getpid()) + "-" + std::to_string(number++) + ".csv");
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TextFile() { fs::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<DirectionSample> samples_in(const std::string& text) {
  return read_directions(TextFile(text).path());
}

/// Angles that follow f(x, y) on a square raster of the rectangle 0…width × 0…height.
template <typename F>
std::string raster(double width, double height, double step, F f) {
  std::string text = "x,y,angle\n";
  for (double x = step / 2; x < width; x += step) {
    for (double y = step / 2; y < height; y += step) {
      text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(f(x, y)) + "\n";
    }
  }
  return text;
}

DirectionField field_of(const Polygon& outline, const fs::path& file, double z = 0, double pitch = 0.25) {
  Zone zone;
  zone.pattern.kind = PatternKind::field;
  zone.pattern.field = file;
  return make_direction_field(whole(outline), {zone}, read_zone_directions({zone}), z, pitch);
}

}  // namespace

TEST_CASE("a file of directions is read with header, comments, spaces and either line end") {
  const auto samples =
      samples_in("\xEF\xBB\xBF# from a calculation\r\nx, y, angle\r\n1, 2.5 ,+30\r\n\r\n# more\n-3e1,4,210");
  REQUIRE(samples.size() == 2);
  CHECK(samples[0].position == Vec2(1, 2.5));
  CHECK(samples[1].position == Vec2(-30, 4));
  CHECK(direction(samples[0].v) == Approx(30 * one_degree));
  CHECK((samples[0].v - samples[1].v).norm() < 1e-12);  // 210° is 30°
}

TEST_CASE("the third of four columns is z") {
  const auto samples = samples_in("1,2,0.3,45\n");
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].z == 0.3);
  CHECK(direction(samples[0].v) == Approx(45 * one_degree));
}

TEST_CASE("a file that is not a list of directions is refused with the line and a remedy") {
  const auto [text, line, part] = GENERATE(table<std::string, std::string, std::string>({
      {"x,y,angle\n1,2,3\n1,2,nan\n", "line 3", "nan"},
      {"1,2,inf\n", "line 1", "inf"},
      {"# c\n\n1,2,1e999\n", "line 3", "inf"},
      {"1,2,3\n4,5\n", "line 2", "two numbers"},
      {"x,y,angle\n7\n", "line 2", "one number"},
      {"1,2,3\n1,2,3,4\n", "line 2", "4 numbers, but 3"},
      {"1,2,3,4,5\n", "line 1", "more than four"},
      {"1,2,3\nx,y,angle\n", "line 2", "\"x\""},
      {"1,2,\n", "line 1", "missing"},
      {"1;2;3\n4;5;6\n", "line 2", "\"4;5;6\""},
      {"angle,x,y\n1,2,3\n", "line 1", "\"angle\" is in the wrong place"},
      {"x,y,angle,z\n1,2,3,4\n", "line 1", "\"angle\" is in the wrong place"},
      {"1,2,3mm\n", "line 1", "\"3mm\""},
      {"2e5,2,3\n", "line 1", "out of reach"},
      {"1,nan,3\n", "line 1", "out of reach"},
      {"", "", "no direction"},
      {"x,y,angle\n", "", "no direction"},
  }));
  INFO(text);
  const TextFile file(text);
  try {
    read_directions(file.path());
    FAIL("not refused");
  } catch (const ModelError& error) {
    CHECK(error.place() == line);
    CHECK_THAT(error.problem(), Catch::Contains(part));
    CHECK(error.file() == file.path().string());
    CHECK_FALSE(error.remedy().empty());
  }
  CHECK_THROWS_AS(read_directions(fs::temp_directory_path() / "unicursal-no-such.csv"), FileError);
}

TEST_CASE("random bytes are either read or refused") {
  Random random(41);
  const std::string letters = "0123456789.,-+eE\n\r #xyn\t\xEF";
  for (int k = 0; k < 3000; ++k) {
    std::string text;
    for (std::size_t n = random.below(60); n > 0; --n) text += letters[random.below(letters.size())];
    try {
      for (const DirectionSample& s : samples_in(text)) REQUIRE(s.v.norm() == Approx(1));
    } catch (const ModelError&) {
    }
  }
}

TEST_CASE("a raster of directions is reproduced by the field") {
  // Turns by 180° over the plate, so that angles wrap around.
  const auto angle = [](double x, double y) { return 9 * x + 4 * y; };
  const TextFile file(raster(20, 10, 0.5, angle));
  const DirectionField field = field_of(rectangle(20, 10), file.path());
  CHECK(field.aligned_area() == Approx(200).epsilon(1e-6));
  Random random(42);
  for (int k = 0; k < 500; ++k) {
    const Vec2 p(random.uniform(0.5, 19.5), random.uniform(0.5, 9.5));
    const double turn = direction(field.at(p)) - one_degree * angle(p.x(), p.y());
    REQUIRE(std::abs(std::sin(turn)) < 3 * one_degree);
  }
}

TEST_CASE("the spacing of samples depends on where they are, not on their box") {
  CHECK(ScatteredDirections(samples_in(raster(20, 10, 0.5, [](double, double) { return 1.0; }))).spacing() ==
        Approx(0.5).epsilon(0.2));
  // Two patches far apart.
  std::string text = raster(5, 5, 0.25, [](double, double) { return 1.0; });
  for (double x = 500; x < 505; x += 0.25) {
    for (double y = 700; y < 705; y += 0.25) {
      text += std::to_string(x) + "," + std::to_string(y) + ",3\n";
    }
  }
  CHECK(ScatteredDirections(samples_in(text)).spacing() == Approx(0.25).epsilon(0.5));
}

TEST_CASE("no direction is asked for farther than two spacings from every sample") {
  const TextFile file(raster(5, 10, 0.5, [](double, double) { return 20.0; }));
  const DirectionField field = field_of(rectangle(20, 10), file.path());
  CHECK(direction(field.at({4.6, 5})) == Approx(20 * one_degree));
  CHECK(field.at({5.4, 5}).norm() == Approx(1));
  CHECK(field.at({7.1, 5}).norm() == 0);
  CHECK(field.aligned_area() == Approx(57).margin(4));
}

TEST_CASE("a single sample, samples in one place and samples on a line do no harm") {
  const std::string text = GENERATE("1,1,30\n", "1,1,30\n1,1,30\n1,1,30\n1,1,30\n1,1,30\n",
                                    "0,1,30\n0.5,1,30\n1,1,30\n1.5,1,30\n2,1,30\n2.5,1,30\n");
  const TextFile file(text);
  const DirectionField field = field_of(rectangle(5, 5), file.path());
  CHECK(direction(field.at({1, 1})) == Approx(30 * one_degree));
  CHECK(field.at({4.5, 4.5}).norm() == 0);
}

TEST_CASE("samples that contradict each other ask for no direction") {
  const TextFile file("1,1,0\n1,1,90\n");
  CHECK(field_of(rectangle(2, 2), file.path()).at({1, 1}).norm() < 1e-6);
}

TEST_CASE("samples in space count near the height of the cut") {
  std::string text;
  for (double x = 0.25; x < 6; x += 0.5) {
    for (double y = 0.25; y < 6; y += 0.5) {
      for (double z = 0; z < 10; z += 0.5) {
        text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "," +
                std::to_string(10 * z) + "\n";
      }
    }
  }
  const TextFile file(text);
  for (const double z : {1.0, 4.2, 8.6}) {
    const DirectionField field = field_of(rectangle(6, 6), file.path(), z);
    CHECK(direction(field.at({3, 3})) == Approx(10 * z * one_degree).margin(2 * one_degree));
  }
  CHECK(field_of(rectangle(6, 6), file.path(), 15).empty());
  const TextFile flat("1,1,7,25\n1.5,1,7,25\n");  // one z: applies at every height
  CHECK(direction(field_of(rectangle(2, 2), flat.path(), 3).at({1, 1})) == Approx(25 * one_degree));
}

TEST_CASE("a hundred thousand samples in one spot and a few far away are read in time") {
  std::string text;
  Random random(43);
  for (int k = 0; k < 100'000; ++k) {
    text += std::to_string(5 + 1e-3 * random.uniform()) + ",5,40\n";
  }
  for (int k = 0; k < 1000; ++k) {
    text += std::to_string(random.uniform(0, 50)) + "," + std::to_string(random.uniform(0, 50)) + ",40\n";
  }
  const TextFile file(text);
  CHECK(direction(field_of(rectangle(50, 50), file.path()).at({5, 5})) == Approx(40 * one_degree));
}
