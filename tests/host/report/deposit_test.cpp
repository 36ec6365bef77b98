#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "host/report/deposit_check.hpp"
#include "host/report/summary.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using test::TempFolder;

using gcode::Mixture;

core::Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

const std::vector<IntendedMaterial> red_and_blue{gcode::Mixture({1, 0, 0}), gcode::Mixture({0, 1, 0})};

/// Red to the left of x = 20, blue to the right; 20 × 10 mm in all.
TargetLayer two_zones() {
  return {3, 0.8, 0.2, {{box(10, 10, 20, 20), 0}, {box(20, 10, 30, 20), 1}}};
}

/// A raster with the pixel that a function gives for each place.
class Laid : public sim::LayerRaster {
 public:
  using Function = std::function<sim::RasterPixel(double x, double y)>;

  Laid(sim::RasterFrame frame, Function at) : frame_(frame), at_(std::move(at)) {}

  sim::RasterFrame frame() const override { return frame_; }
  void read_row(std::uint64_t row, std::span<sim::RasterPixel> pixels) const override {
    for (std::uint64_t c = 0; c < frame_.columns; ++c) {
      pixels[c] = at_(frame_.left + (static_cast<double>(c) + 0.5) * frame_.pixel,
                      frame_.bottom + (static_cast<double>(row) + 0.5) * frame_.pixel);
    }
  }

 private:
  sim::RasterFrame frame_;
  Function at_;
};

sim::RasterPixel plastic(double fill, std::array<double, sim::RasterPixel::feeders> shares) {
  sim::RasterPixel pixel;
  if (fill > 0) pixel.add(fill, shares);
  return pixel;
}

const std::array<double, sim::RasterPixel::feeders> red{1}, blue{0, 1};
constexpr sim::RasterFrame frame{0.8, 0.2, 5.03, 4.98, 0.05, 600, 400};

JudgedLayer judged(const Laid::Function& at, const sim::RasterFrame& where = frame, bool draw = false) {
  const Laid laid(where, at);
  std::uint64_t row = 0;
  return judge(
      two_zones(), where, [&](std::span<sim::RasterPixel> pixels) { laid.read_row(row++, pixels); },
      red_and_blue, draw);
}

bool inside(double x, double y) {
  return x > 10 && x < 30 && y > 10 && y < 20;
}

sim::RasterPixel perfect(double x, double y) {
  return inside(x, y) ? plastic(1, x < 20 ? red : blue) : sim::RasterPixel{};
}

}  // namespace

TEST_CASE("A layer as it should be has no gaps and nothing wrong") {
  const DepositFindings f = judged(perfect).findings;
  CHECK(f.area == Approx(200).epsilon(0.005));
  CHECK(f.gaps == 0);
  CHECK(f.overfill == Approx(0).margin(1e-9));
  CHECK(f.spilled == 0);
  CHECK(f.wrong == 0);
  CHECK(f.mixture_error == Approx(0).margin(1e-3));
  CHECK(f.fill.percentile(0.5) == Approx(1).margin(0.01));
}

TEST_CASE("Missing plastic, surplus, and plastic beside the part are measured") {
  const DepositFindings f = judged([](double x, double y) {
                              if (y > 18 && inside(x, y)) return sim::RasterPixel{};  // 20 × 2 mm missing
                              if (y < 11 && inside(x, y))
                                return plastic(1.5, x < 20 ? red : blue);  // half too high
                              if (x > 30 && x < 30.5 && y > 10 && y < 20) return plastic(1, blue);
                              return perfect(x, y);
                            }).findings;
  CHECK(f.gaps == Approx(40).epsilon(0.03));
  CHECK(f.overfill == Approx(10).epsilon(0.06));
  CHECK(f.spilled == Approx(5).epsilon(0.11));
  CHECK(f.gap_fraction() == Approx(0.2).epsilon(0.03));
  CHECK(f.fill_deviation() > 0.35);
}

TEST_CASE(
    "A place is wrong where the other zone's mixture is nearer, and its way to the border is measured") {
  // Blue begins 3 mm too late; the middle of that is a mixture of both, nearer to red.
  const DepositFindings f = judged([](double x, double y) {
                              if (!inside(x, y)) return sim::RasterPixel{};
                              if (x < 23) return plastic(1, red);
                              if (x < 24) return plastic(1, {0.4, 0.6});
                              return plastic(1, blue);
                            }).findings;
  CHECK(f.wrong == Approx(30).epsilon(0.03));
  CHECK(f.mixture_error == Approx(30 + 0.4 * 10).epsilon(0.03));
  CHECK(f.wrong_distance.percentile(0.5) == Approx(1.5).margin(0.1));
  CHECK(f.wrong_distance.percentile(1) == Approx(3).margin(0.1));
}

TEST_CASE("A bead that runs beside the part is outside, the rim, the prime line and the skirt are not") {
  TargetLayer target = two_zones();
  target.bead_width = 0.8;
  target.prime = {{{8, 7}, {28, 7}, 1.0}};
  target.skirt = {{{7.0, 9}, {7.0, 21}, 0.4}};
  const auto within = [](double x, double y, double x0, double y0, double x1, double y1) {
    return x > x0 && x < x1 && y > y0 && y < y1;
  };
  const auto as_it_should = [&](double x, double y) {
    if (within(x, y, 8, 6.5, 28, 7.5) || within(x, y, 6.8, 9, 7.2, 21)) return plastic(1, red);
    if (within(x, y, 10, 19, 30, 20.38)) return plastic(1, x < 20 ? red : blue);  // a rim of 0.38 mm
    return perfect(x, y);
  };
  const auto found = [&](const Laid::Function& at) {
    const Laid laid(frame, at);
    std::uint64_t row = 0;
    const auto rows = [&](std::span<sim::RasterPixel> pixels) { laid.read_row(row++, pixels); };
    return judge(target, frame, rows, red_and_blue, false).findings;
  };
  const DepositFindings good = found(as_it_should);
  CHECK(good.outside == 0);
  CHECK(good.prime == Approx(20 * 1 * 0.2).epsilon(0.02));
  CHECK(good.skirt == Approx(12 * 0.4 * 0.2).epsilon(0.02));

  // The topmost bead, 0.8 mm wide, is displaced by 1 mm: 0.6 of its 0.8 mm lie beyond the rim.
  const DepositFindings displaced = found([&](double x, double y) {
    if (within(x, y, 12, 20.2, 22, 21)) return plastic(1, red);
    return as_it_should(x, y);
  });
  CHECK(displaced.outside == Approx(10 * 0.6 * 0.2).epsilon(0.05));
  // Far from the part, where the other figures do not look; and a skirt far from its place.
  const DepositFindings far = found([&](double x, double y) {
    if (within(x, y, 33, 10, 34, 12)) return plastic(1.5, red);
    return as_it_should(x, y);
  });
  CHECK(far.outside == Approx(2 * 1.5 * 0.2).epsilon(0.05));
  CHECK(far.spilled == good.spilled);
  target.skirt = {{{7.0, 5}, {28.0, 5}, 0.4}};
  CHECK(found(as_it_should).outside == Approx(good.skirt).epsilon(0.01));
}

TEST_CASE("Nothing was laid beyond the raster") {
  const sim::RasterFrame half{0.8, 0.2, 5.03, 4.98, 0.05, 600, 200};  // up to y = 14.98
  CHECK(judged(perfect, half).findings.gaps == Approx(200 * 5.02 / 10).epsilon(0.01));
  const sim::RasterFrame none{0.8, 0.2, 100, 100, 0.05, 10, 10};
  CHECK(judged(perfect, none).findings.gap_fraction() == 1);
}

TEST_CASE("The maps show what is wrong where it is") {
  const JudgedLayer layer = judged(
      [](double x, double y) {
        if (x < 12 && inside(x, y)) return sim::RasterPixel{};
        if (x > 28 && inside(x, y)) return plastic(1, red);
        return perfect(x, y);
      },
      frame, true);
  // 22 × 12 mm with the margin, 20 pixels for a mm.
  REQUIRE(layer.gaps);
  CHECK(layer.gaps->width() == Approx(441).margin(1));
  const std::size_t middle = layer.gaps->height() / 2;
  CHECK(layer.gaps->at(30, middle).r < 60);    // missing: dark
  CHECK(layer.gaps->at(200, middle).r > 200);  // full: pale
  const picture::Colour right = layer.mixtures->at(300, middle);
  bool marked = false;
  for (std::size_t x = 385; x < 415; ++x) marked = marked || layer.mixtures->at(x, middle).b > 140;
  CHECK(right.r > right.b);
  CHECK(marked);
}

TEST_CASE("The worst places are windows around what is amiss, and the maps say where they lie") {
  const auto within = [](double x, double y, double x0, double y0, double side) {
    return x > x0 && x < x0 + side && y > y0 && y < y0 + side;
  };
  const JudgedLayer layer = judged(
      [&](double x, double y) {
        if (within(x, y, 14, 13, 1) || within(x, y, 26, 18, 0.5)) return sim::RasterPixel{};
        if (within(x, y, 27, 12, 1.5)) return plastic(1, red);
        return perfect(x, y);
      },
      frame, true);
  REQUIRE(layer.worst.size() == 2);
  const WorstPlace &gap = layer.worst[0], &mixture = layer.worst[1];
  CHECK(gap.kind == WorstPlace::Kind::gap);
  CHECK(gap.layer == 3);
  CHECK(gap.area == Approx(1).epsilon(0.15));
  CHECK(gap.at.x() == Approx(14.5).margin(1));
  CHECK(gap.at.y() == Approx(13.5).margin(1));
  CHECK(mixture.kind == WorstPlace::Kind::mixture);
  CHECK(mixture.at.x() == Approx(27.75).margin(1));
  // The pixel of the map at the middle of the gap is dark, 0.7 mm beside it pale.
  const auto at = [&](double x, double y) {
    return layer.gaps->at(static_cast<std::size_t>((x - layer.place.corner.x()) / layer.place.pixel),
                          static_cast<std::size_t>((layer.place.corner.y() - y) / layer.place.pixel));
  };
  CHECK(at(14.5, 13.5).r < 60);
  CHECK(at(15.2, 13.5).r > 200);
  CHECK(at(14.5, 14.2).r > 200);
}

TEST_CASE("The worst places are different ones, the worst first") {
  using Kind = WorstPlace::Kind;
  const auto chosen = choose_worst({{Kind::gap, 0, {10, 10}, 1},
                                    {Kind::gap, 1, {11, 10}, 3},  // above the first
                                    {Kind::mixture, 1, {11, 10}, 2},
                                    {Kind::gap, 2, {30, 10}, 0.5},
                                    {Kind::overfill, 2, {30, 10}, 0.4}},
                                   3);
  REQUIRE(chosen.size() == 3);
  CHECK(chosen[0].layer == 1);
  CHECK(chosen[1].kind == Kind::mixture);
  CHECK(chosen[2].area == 0.5);
  CHECK(choose_worst({}, 3).empty());
}

TEST_CASE("Regions are scanned with their holes, and the later ones cover") {
  const PixelGrid grid{{-1, -2}, 0.1, 200, 150};
  core::Polygon ring = box(0, 0, 10, 10);
  ring.holes.push_back({{3, 3}, {3, 7}, {7, 7}, {7, 3}});
  const auto labels = scan({{ring, 4}, {box(8, 8, 30, 9), 1}}, grid);
  const auto area = [&](RegionLabel label) {
    return static_cast<double>(std::count(labels.begin(), labels.end(), label)) * 0.01;
  };
  CHECK(area(4) == Approx(100 - 16 - 2).epsilon(0.02));
  CHECK(area(1) == Approx(11).epsilon(0.02));  // cut off at the grid's border, x = 19
  CHECK(labels[static_cast<std::size_t>(70) * 200 + 60] == outside_all);  // (5, 5) lies in the hole
}

TEST_CASE("The distance to another region agrees with a count of pixels") {
  const PixelGrid grid{{0, 0}, 0.25, 37, 29};
  std::mt19937 random(3);
  std::discrete_distribution<int> kind{70, 25, 2, 1};
  std::vector<RegionLabel> labels(grid.size());
  for (auto& label : labels) {
    const int k = kind(random);
    label = k == 0 ? outside_all : static_cast<RegionLabel>(k);
  }
  const auto distances = distance_to_other_label(labels, grid);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == outside_all) continue;
    double nearest = 1e9;
    for (std::size_t j = 0; j < labels.size(); ++j) {
      if (labels[j] == outside_all || labels[j] == labels[i]) continue;
      const auto d = [](std::size_t a, std::size_t b) {
        return static_cast<double>(a) - static_cast<double>(b);
      };
      nearest = std::min(nearest, std::hypot(d(i % 37, j % 37), d(i / 37, j / 37)));
    }
    CHECK(distances[i] == Approx((nearest - 0.5) * grid.pixel).margin(1e-4));
  }
}

TEST_CASE("Findings of layers add up") {
  DepositFindings sum;
  const DepositFindings one = judged(perfect).findings;
  const DepositFindings none = judged([](double, double) { return sim::RasterPixel{}; }).findings;
  sum += one;
  sum += none;
  CHECK(sum.gap_fraction() == Approx(0.5));
  CHECK(sum.fill_deviation() == Approx(0.5));
  CHECK(sum.fill.percentile(0.25) == Approx(0).margin(0.01));
  CHECK(sum.fill.percentile(0.75) == Approx(1).margin(0.01));
}

TEST_CASE("Layers are judged as they come out of the stream, each against its own plan") {
  TempFolder folder;
  const auto file = folder / "rasters";
  {
    sim::RasterWriter writer(file);
    for (const double z : {0.4, 0.6, 0.8, 2.0}) {  // nothing is to lie at the last one's height
      sim::RasterFrame here = frame;
      here.z = z;
      writer.layer(Laid(here, [z](double x, double y) {
        return z < 0.5            ? plastic(inside(x, y) ? 1 : 0, blue)
               : z < 0.7 || z > 1 ? perfect(x, y)
                                  : sim::RasterPixel{};
      }));
    }
  }
  folder.write("gaps-0007.png", "of a longer print");
  folder.write("gaps-notes.txt", "of the user");
  DepositCheck check(red_and_blue, folder / "", {});
  CHECK_FALSE(std::filesystem::exists(folder / "gaps-0007.png"));
  CHECK(std::filesystem::exists(folder / "gaps-notes.txt"));
  for (const std::size_t index : {0u, 1u, 2u, 3u}) {
    TargetLayer target = two_zones();
    target.index = index;
    target.top = 0.2 + 0.2 * static_cast<double>(index);
    check.expect(target);
  }
  check.watch(::open(file.c_str(), O_RDONLY));
  check.finish();
  CHECK_FALSE(check.problem());
  const nlohmann::json report = check.to_json();
  REQUIRE(report["layers"].size() == 3);
  CHECK(report["layers"][0]["layer"] == 1);
  CHECK(report["layers"][0]["mixture"]["wrong_fraction"].get<double>() == Approx(0.5).epsilon(0.02));
  CHECK(report["layers"][1]["gap_fraction"] == 0);
  CHECK(report["layers"][2]["gap_fraction"] == 1);
  CHECK(std::filesystem::exists(folder / "gaps-0001.png"));
  CHECK(std::filesystem::exists(folder / "mixtures-0003.png"));
  CHECK(summary(check.total()).find("gaps 33") != std::string::npos);
  CHECK(check.total().outside == Approx(200 * 0.2).epsilon(0.01));
}

TEST_CASE("An interrupted stream is reported, and the layers before are kept") {
  TempFolder folder;
  const auto file = folder / "rasters";
  {
    sim::RasterWriter writer(file);
    writer.layer(Laid(frame, perfect));
    sim::RasterFrame next = frame;
    next.z = 1.0;
    writer.layer(Laid(next, perfect));
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1000);
  DepositCheck check(red_and_blue, std::nullopt, {});
  TargetLayer second = two_zones();
  second.index = 4;
  second.top = 1.0;
  check.expect(two_zones());
  check.expect(second);
  check.watch(::open(file.c_str(), O_RDONLY));
  check.finish();
  CHECK(check.problem());
  CHECK(check.to_json()["layers"].size() == 1);
}

TEST_CASE("Flow is judged by the time for which it was nominal") {
  const nlohmann::json seen = {
      {"motion",
       {{"bead_seconds", 100.0},
        {"mean_speed", 19.8},
        {"starvations", 2},
        {"hasty_stops", 1},
        {"stopped_seconds", 0.4},
        {"flow_seconds", {{0.5, 2.0}, {1.5, 6.0}, {1.92, 20.0}, {2.0, 70.0}, {2.4, 2.0}}},
        {"flow_by_second", {{1.5, 2.0}, {1.6, 6.0}, {2.0, 92.0}}}}},
      {"layers", {{{"travels", 1}, {"travel_mm", 10.5}}, {{"travels", 2}, {"travel_mm", 4.0}}}}};
  const MotionFindings f = motion_findings(seen, 2);
  CHECK(f.instants_in_tolerance == Approx(0.9));
  CHECK(f.seconds_in_tolerance == Approx(0.92));
  // In 2 % of the seconds the flow is below 1.6, in 8 % below 2: a fifth is missing where a twentieth is
  // allowed.
  CHECK(f.holdable_flow == Approx(2 * std::cbrt(0.05 / 0.2)));
  CHECK(f.travels == 3);
  CHECK(f.travel == Approx(14.5));
  CHECK(f.starvations == 2);
  CHECK(summary(f).find("2 starvations, 1 stop for") != std::string::npos);
}

TEST_CASE("An empty report of the simulator does no harm") {
  const MotionFindings f = motion_findings(nlohmann::json::object(), 2);
  CHECK(f.seconds_in_tolerance == 0);
  CHECK(f.travels == 0);
}

}  // namespace unicursal::host
