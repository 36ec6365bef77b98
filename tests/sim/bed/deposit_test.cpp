#include <png.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "../bench.hpp"
#include "../folder.hpp"
#include "sim/bed/bead_pictures.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/motion/move_sinks.hpp"
#include "sim/nozzle/feed_log.hpp"

using namespace unicursal::sim;
namespace fs = std::filesystem;

namespace {

Bead bead(Position from, Position to, double volume) {
  return {from, to, volume, {1}, 0, 1};
}

}  // namespace

TEST_CASE("a layer's height is its distance from the previous layer") {
  Deposit deposit({});
  for (const double z : {0.3, 0.2, 0.4, 0.4, 0.65}) deposit.laid(bead({0, 0, z}, {10, 0, z}, 1));
  REQUIRE(deposit.layers().size() == 4);
  const auto height = [&](std::size_t i) { return deposit.layers()[i].height; };
  CHECK(height(0) == Approx(0.3));
  CHECK(height(1) == Approx(0.2));  // after a way down it counts from the bed
  CHECK(height(2) == Approx(0.2));
  CHECK(height(3) == Approx(0.25));
  CHECK(deposit.layers()[2].beads == 2);
}

TEST_CASE("travels longer than 1.5 bead widths are counted") {
  Deposit deposit({});
  deposit.travelled({0, 0, 5}, {10, 0, 5});
  deposit.laid(bead({10, 0, 0.2}, {20, 0, 0.2}, 0.8));  // 0.4 mm wide
  deposit.travelled({20, 0, 0.2}, {20.5, 0, 0.2});
  deposit.laid(bead({20.5, 0, 0.2}, {30, 0, 0.2}, 0.76));
  deposit.travelled({30, 0, 0.2}, {30.5, 0, 0.2});
  deposit.travelled({30.5, 0, 0.2}, {31, 0, 0.2});
  deposit.laid(bead({31, 0, 0.2}, {40, 0, 0.2}, 0.72));
  const DepositedLayer& layer = deposit.layers().at(0);
  CHECK(layer.travels == 2);
  CHECK(layer.travel == Approx(11));
  CHECK(layer.length == Approx(28.5));
  CHECK(deposit.extents().min_x == 10);
  CHECK(deposit.extents().max_x == 40);
}

TEST_CASE("the laid volume is the fed volume") {
  Deposit deposit({});
  Nozzle nozzle(1.75, Chamber({}, 3), deposit);
  FeedLog feed;
  MoveSinks sinks({&feed, &nozzle});
  Firmware firmware({}, personality("marlin"), sinks, [](std::string_view) {});
  const auto send = [&](const std::string& line) {
    firmware.receive(line + "\n");
    while (firmware.blocked()) firmware.advance(*firmware.next_event());
  };
  send("M109 S200");
  send("M83");
  send("G1 E4 F1800");
  for (const char* tool : {"T0", "T1"}) {
    send(tool);
    for (int i = 0; i < 50; ++i) {
      send(fmt::format("G1 X{} Y{} E0.0523 F1200", i % 2 == 0 ? 10 : 12, i));
    }
  }
  send("G1 E-4 F1800");
  firmware.run_down();

  const double area = std::numbers::pi * 1.75 * 1.75 / 4;
  CHECK(deposit.volume() == Approx(100 * 0.0523 * area).epsilon(1e-3));
  CHECK(deposit.volume() == Approx(feed.extruded() * area).epsilon(1e-12));
  CHECK(deposit.dropped() == Approx(4 * area));
  const PerFeeder<double> left = nozzle.chamber().content(), before = Chamber({}, 3).content();
  for (std::size_t f = 0; f < 3; ++f) {
    CHECK(nozzle.fed()[f] == Approx(deposit.by_feeder()[f] + left[f] - before[f]).epsilon(1e-6));
  }
  CHECK(feed.fed_in_place() == Approx(4));
  CHECK(feed.retracted() == Approx(4));
  REQUIRE(feed.mixtures().size() == 2);
  const auto& steps = firmware.planner().feeder_steps();
  for (std::size_t f = 0; f < 3; ++f) {
    CHECK(steps[f] ==
          feed.mixtures()[0].feeder_steps[f] + feed.mixtures()[1].feeder_steps[f] + feed.idle_steps()[f]);
  }
  CHECK(feed.mixtures()[0].feeder_steps[0] == std::llround(feed.mixtures()[0].extruded * 400));
}

namespace {

/// A picture that was read back, RGB.
struct Pixels {
  std::size_t width = 0, height = 0;
  std::vector<unsigned char> bytes;

  explicit Pixels(const fs::path& file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&png, file.c_str()) != 0);
    png.format = PNG_FORMAT_RGB;
    width = png.width;
    height = png.height;
    bytes.resize(PNG_IMAGE_SIZE(png));
    REQUIRE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) != 0);
  }
  bool same(std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1) const {
    const auto at = [&](std::size_t x, std::size_t y) {
      return bytes.begin() + static_cast<std::ptrdiff_t>(3 * (y * width + x));
    };
    return std::equal(at(x0, y0), at(x0, y0) + 3, at(x1, y1));
  }
};

}  // namespace

TEST_CASE("each layer has a picture with the beads in place, all have one frame, without the prime line") {
  const Folder folder;
  const bool apart = GENERATE(true, false);
  {
    clear_pictures(folder.path());
    BeadStore store(folder.path());
    Deposit deposit({&store});
    if (apart) {
      deposit.laid(bead({100, 90, 0.2}, {160, 90, 0.2}, 60 * 0.2 * 0.5));
      deposit.laid(bead({160, 90, 0.2}, {190, 90, 0.2}, 30 * 0.2 * 0.5));
      deposit.travelled({190, 90, 0.2}, {10, 10, 0.2});
    }
    deposit.laid(bead({10, 10, 0.2}, {30, 10, 0.2}, 20 * 0.2 * 0.5));
    deposit.laid(bead({30, 10, 0.2}, {30, 20, 0.2}, 10 * 0.2 * 0.5));
    deposit.laid(bead({20, 10, 0.4}, {20, 20, 0.4}, 10 * 0.2 * 0.5));
    draw_layers(store, folder.path(), 0.1);
    draw_part(store, folder.path());
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.path())) files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  CHECK(files == std::vector<fs::path>{"deposit-0000.png", "deposit-0001.png", "part.png"});

  // 20 × 10 mm of centre lines with a margin.
  const Pixels first(folder.path() / "deposit-0000.png"), second(folder.path() / "deposit-0001.png");
  CHECK(first.width == second.width);
  CHECK(first.height == second.height);
  CHECK(first.width - first.height == 100);
  CHECK(first.width < 260);
  // The first layer's bead runs along the lower border, the second layer's vertically through the middle.
  const std::size_t bottom = first.height - (first.height - 100) / 2;
  CHECK_FALSE(first.same(first.width / 2, bottom, 0, 0));
  CHECK(first.same(first.width / 2, first.height / 2, 0, 0));
  CHECK_FALSE(second.same(second.width / 2, second.height / 2, 0, 0));
  CHECK(second.same(second.width - 1, second.height / 2, 0, 0));
  const Pixels part(folder.path() / "part.png");
  CHECK(part.width < 700);  // 27 mm wide at 16 pixels per mm
}
