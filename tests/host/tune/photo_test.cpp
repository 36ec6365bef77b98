// `unicursal tune transition --photo`: the program itself reads photos of strips.
#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "host/job/profile.hpp"
#include "host/tune/strip.hpp"
#include "tests/host/support/photo_bench.hpp"

namespace unicursal {
namespace {

using test::HiddenNozzle;
using test::PhotoReading;

/// Three megapixels, as of a cheap camera.
camera::Conditions smaller(camera::Conditions conditions, std::size_t width = 2000) {
  conditions.width = width, conditions.height = width * 3 / 4;
  return conditions;
}

camera::Conditions conditions_named(const std::string& name) {
  for (const camera::Conditions& one : camera::conditions()) {
    if (one.name == name) return one;
  }
  throw std::logic_error("unknown conditions: " + name);
}

void expect_refusal(const PhotoReading& reading) {
  INFO(reading.outcome.out << reading.outcome.err);
  CHECK(reading.outcome.code == 2);
  CHECK(reading.outcome.err.rfind("unicursal: ", 0) == 0);
  CHECK(reading.outcome.err.find("; ") != std::string::npos);  // the remedy
  CHECK(reading.untouched);
}

void expect_volumes(const PhotoReading& reading, const HiddenNozzle& nozzle) {
  CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks);
  INFO(reading.outcome.out << reading.outcome.err);
  REQUIRE(reading.outcome.code == 0);
  REQUIRE(reading.dead);
  REQUIRE(reading.mixing);
  CHECK(reading.error(nozzle) <= 0.1);
}

}  // namespace

TEST_CASE("Photos of strips give the volumes of hidden nozzles", "[tuning][photo][optimised]") {
  struct Case {
    camera::FilamentPair pair;
    const char* conditions;
  };
  // Each nozzle in other colours and other light. The long test has all combinations.
  const Case cases[] = {
      {{"blue", "red"}, "on glass"}, {{"yellow", "blue"}, "lamp light"}, {{"green", "magenta"}, "daylight"}};
  const test::TempFolder folder;
  const auto nozzles = test::hidden_nozzles(std::size(cases));
  for (std::size_t i = 0; i < nozzles.size(); ++i) {
    CAPTURE(cases[i].conditions);
    const PhotoReading reading =
        test::photographed(test::printed_strip(nozzles[i]), cases[i].pair,
                           smaller(conditions_named(cases[i].conditions)), folder / "photo.jpg");
    expect_volumes(reading, nozzles[i]);
    CHECK_FALSE(reading.untouched);
  }
}

TEST_CASE("A photo that the camera has noted as turned gives the same volumes",
          "[tuning][photo][optimised]") {
  const test::TempFolder folder;
  const HiddenNozzle nozzle{3, 8, 2};
  const camera::Photo photo =
      camera::take_photo(test::printed_strip(nozzle), {"blue", "red"}, smaller(conditions_named("daylight")));
  camera::write_photo(folder / "upright.png", photo);
  camera::write_photo(folder / "turned.jpg", photo, 90, 6);
  const PhotoReading upright = test::read_photo(folder / "upright.png");
  const PhotoReading turned = test::read_photo(folder / "turned.jpg");
  expect_volumes(upright, nozzle);
  expect_volumes(turned, nozzle);
  CHECK(turned.dead->value == Approx(upright.dead->value).margin(0.3));
  CHECK(turned.mixing->value == Approx(upright.mixing->value).margin(0.5));
}

TEST_CASE("Photos that cannot be read are refused with a remedy", "[tuning][photo][optimised]") {
  const test::TempFolder folder;
  const camera::PrintedLayer strip = test::printed_strip({3, 8, 2});
  for (const camera::Conditions& conditions : camera::unreadable_conditions()) {
    CAPTURE(conditions.name);
    expect_refusal(test::photographed(strip, {"blue", "red"},
                                      smaller(conditions, std::min<std::size_t>(conditions.width, 1400)),
                                      folder / "photo.jpg"));
  }
  CAPTURE("similar colours");
  expect_refusal(test::photographed(strip, camera::similar_pair(),
                                    smaller(conditions_named("from above"), 1400), folder / "photo.jpg"));
}

TEST_CASE("A reflection on a reference line is named as the reason", "[tuning][photo][optimised]") {
  const test::TempFolder folder;
  const camera::PrintedLayer strip = test::printed_strip({3, 8, 2});
  const host::Profile profile = host::load_profile(folder.write("profile.toml", test::unmeasured_profile()));
  const auto lanes = host::make_strip(profile.printer, {}).straight;
  const auto line = std::find_if(lanes.rbegin(), lanes.rend(), [](const host::Strip::Lane& lane) {
    return lane.pure && lane.shade == host::Shade::to;
  });
  REQUIRE(line != lanes.rend());
  const core::Vec2 place = (line->from + line->to) / 2;
  const camera::Rectangle printed = strip.printed();
  camera::Conditions conditions = smaller(conditions_named("from above"), 1400);
  conditions.light.exposure = 0.5;
  conditions.light.glares = {
      {(place.x() - printed.left) / printed.width(), (place.y() - printed.bottom) / printed.height(), 9, 1}};
  const PhotoReading reading = test::photographed(strip, {"white", "blue"}, conditions, folder / "photo.jpg");
  expect_refusal(reading);
  CHECK(reading.outcome.err.find("hides a reference line") != std::string::npos);
}

TEST_CASE("Files that are not whole photos are refused with a remedy", "[tuning][photo]") {
  const test::TempFolder folder;
  camera::PrintedLayer dot = camera::empty_layer({0, 0, 20, 10}, 0.1, 0.2);
  dot.fill.back() = static_cast<std::uint8_t>(camera::PrintedLayer::full);
  camera::Conditions small;
  small.width = 640, small.height = 480;
  camera::write_photo(folder / "whole.jpg", camera::take_photo(dot, {"blue", "red"}, small));
  camera::write_photo(folder / "whole.png", camera::take_photo(dot, {"blue", "red"}, small));
  for (const char* name : {"whole.jpg", "whole.png"}) {
    const std::string bytes = test::read_text(folder / name);
    for (const std::size_t length : {bytes.size() / 2, std::size_t{30}, std::size_t{0}}) {
      CAPTURE(name, length);
      const PhotoReading cut = test::read_photo(folder.write("cut", bytes.substr(0, length)));
      expect_refusal(cut);
      // The whole picture shows one dot, and would be refused for its missing marks.
      const char* const reason = length > 0 ? "is damaged" : "is not a JPEG or PNG picture";
      CHECK(cut.outcome.err.find(reason) != std::string::npos);
    }
  }
  expect_refusal(test::read_photo(folder.write("words.jpg", "This is not a photo.\n")));
  expect_refusal(test::read_photo(folder / "absent.jpg"));
  expect_refusal(test::read_photo(folder.path()));
}

TEST_CASE(
    "Photos of twenty hidden nozzles in ten conditions are read within a twentieth, and all within a tenth",
    "[tuning][photo][long]") {
  const test::TempFolder folder;
  const auto nozzles = test::hidden_nozzles();
  const auto pairs = camera::filament_pairs();
  std::size_t read = 0, within_5 = 0, within_10 = 0;
  for (std::size_t i = 0; i < nozzles.size(); ++i) {
    const camera::PrintedLayer strip = test::printed_strip(nozzles[i]);
    for (const camera::Conditions& conditions : camera::conditions()) {
      CAPTURE(i, conditions.name, pairs[i % pairs.size()].from);
      const PhotoReading reading =
          test::photographed(strip, pairs[i % pairs.size()], conditions, folder / "photo.jpg");
      INFO(reading.outcome.out << reading.outcome.err);
      REQUIRE_FALSE(reading.refused());
      REQUIRE(reading.dead);
      REQUIRE(reading.mixing);
      ++read;
      within_5 += reading.error(nozzles[i]) <= 0.05;
      within_10 += reading.error(nozzles[i]) <= 0.1;
    }
  }
  CHECK(100 * within_5 >= 95 * read);
  CHECK(within_10 == read);
}

}  // namespace unicursal
