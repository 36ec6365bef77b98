#include <catch2/catch.hpp>

#include <fcntl.h>
#include <cmath>
#include <numbers>
#include <random>

#include "../folder.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/bed/spread.hpp"

using namespace unicursal::sim;

namespace {

constexpr double height = 0.2, pixel = 0.05;

Bead bead(double x0, double y0, double x1, double y1, double width, PerFeeder<double> shares = {1}) {
  return {{x0, y0, height}, {x1, y1, height}, std::hypot(x1 - x0, y1 - y0) * width * height, shares, 0, 1};
}

struct Sums {
  double volume = 0, covered = 0, over = 0;  // mm³, mm², mm²
  PerFeeder<double> by_feeder{};
};

/// Sums over the pixels whose centre lies in the box.
Sums sums(const LayerRaster& raster, double x0 = -1e9, double y0 = -1e9, double x1 = 1e9, double y1 = 1e9) {
  const RasterFrame frame = raster.frame();
  std::vector<RasterPixel> row(frame.columns);
  Sums sums;
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    raster.read_row(r, row);
    const double y = frame.bottom + (static_cast<double>(r) + 0.5) * frame.pixel;
    for (std::uint64_t c = 0; c < frame.columns; ++c) {
      const double x = frame.left + (static_cast<double>(c) + 0.5) * frame.pixel;
      if (x < x0 || x > x1 || y < y0 || y > y1) continue;
      const double fill = row[c].fill;
      sums.volume += fill * frame.pixel_area() * frame.height;
      sums.covered += std::min(1.0, fill) * frame.pixel_area();
      sums.over += std::max(0.0, fill - 1) * frame.pixel_area();
      for (std::size_t f = 0; f < max_feeders; ++f)
        sums.by_feeder[f] += row[c].share(f) * fill * frame.pixel_area() * frame.height;
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("every mm³ that is laid is in the raster, with its feeder") {
  Spread spread({60, 60}, pixel, 3);
  spread.begin(height, height);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(0, 60), width(0.2, 2.5), share(0, 1);
  double volume = 0;
  PerFeeder<double> by_feeder{};
  for (int i = 0; i < 300; ++i) {
    const double s = share(random), w = width(random);
    const Bead laid = bead(place(random), place(random), place(random), place(random), w, {s, 0, 1 - s});
    spread.lay(laid, w);
    volume += laid.volume;
    for (std::size_t f = 0; f < 3; ++f) by_feeder[f] += laid.shares[f] * laid.volume;
  }
  const Sums found = sums(spread.raster());
  CHECK(found.volume == Approx(volume).epsilon(1e-6));
  CHECK(spread.lost() == 0);
  CHECK(found.over > 0);
  for (std::size_t f = 0; f < 3; ++f) CHECK(found.by_feeder[f] == Approx(by_feeder[f]).epsilon(1e-3));
}

TEST_CASE("on open ground a bead has the width of its volume, in any direction") {
  const double angle = GENERATE(0.0, 0.3, 0.785398, 1.2), width = GENERATE(0.45, 1.3);
  Spread spread({60, 60}, pixel, 3);
  spread.begin(height, height);
  const double dx = std::cos(angle), dy = std::sin(angle);
  spread.lay(bead(30 - 15 * dx, 30 - 15 * dy, 30 + 15 * dx, 30 + 15 * dy, width), width);
  // The plastic's mean distance from the centre line is width ÷ 4 for a uniform strip.
  const RasterFrame frame = spread.raster().frame();
  std::vector<RasterPixel> row(frame.columns);
  double covered = 0, moment = 0, sided = 0;
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    spread.raster().read_row(r, row);
    for (std::uint64_t c = 0; c < frame.columns; ++c) {
      const double x = frame.left + (static_cast<double>(c) + 0.5) * pixel - 30;
      const double y = frame.bottom + (static_cast<double>(r) + 0.5) * pixel - 30;
      if (std::abs(x * dx + y * dy) > 10) continue;
      covered += row[c].fill;
      moment += row[c].fill * std::abs(y * dx - x * dy);
      sided += row[c].fill * (y * dx - x * dy);
      CHECK(row[c].fill <= 1.0F);
    }
  }
  CHECK(covered * pixel * pixel / 20 == Approx(width).epsilon(0.02));
  CHECK(moment / covered == Approx(width / 4).epsilon(0.04));
  CHECK(sided / covered == Approx(0).margin(0.6 * pixel));
}

TEST_CASE("strands one bead width apart leave no gap, farther apart they do, and closer they pile up") {
  const double width = 0.5;
  const auto plate = [&](double spacing) {
    Spread spread({60, 60}, pixel, 3);
    spread.begin(height, height);
    for (int i = 0; i < 40; ++i) spread.lay(bead(10, 10 + i * spacing, 40, 10 + i * spacing, width), width);
    const Sums inner = sums(spread.raster(), 12, 12, 38, 10 + 38 * spacing);
    return std::pair(1 - inner.covered / (26 * (38 * spacing - 2)), inner.over / (26 * (38 * spacing - 2)));
  };
  const auto [gap, over] = plate(width);
  CHECK(gap < 0.01);
  CHECK(over < 0.01);
  const auto [wide_gap, wide_over] = plate(width * 1.2);
  CHECK(wide_gap == Approx(1 - 1 / 1.2).margin(0.01));
  CHECK(wide_over < 0.001);
  const auto [narrow_gap, narrow_over] = plate(width / 1.4);
  CHECK(narrow_gap < 0.005);
  CHECK(narrow_over > 0.1);
}

TEST_CASE("plastic moves aside next to an older strand, up to a limit") {
  Spread spread({60, 60}, pixel, 3);
  spread.begin(height, height);
  const double width = 0.8;
  spread.lay(bead(10, 20, 50, 20, width), width);      // covers y from 19.6 to 20.4
  spread.lay(bead(10, 20.6, 50, 20.6, width), width);  // has 0.2 mm less room on its lower side
  CHECK(sums(spread.raster(), 15, 19.6, 45, 21.15).covered / 30 == Approx(1.55).margin(0.03));
  CHECK(sums(spread.raster(), 15, 21.3, 45, 25).covered == 0);  // reach: 20.6 + 1.5 · 0.4
}

TEST_CASE("plastic outside the bed is counted as lost") {
  Spread spread({50, 50}, pixel, 3);
  spread.begin(height, height);
  const Bead laid = bead(-200, 10, -180, 10, 0.5);
  spread.lay(laid, 0.5);
  CHECK(spread.lost() == Approx(laid.volume));
  CHECK(spread.empty());
}

TEST_CASE("a new layer begins empty") {
  Spread spread({50, 50}, pixel, 3);
  spread.begin(height, height);
  spread.lay(bead(10, 10, 20, 10, 0.5), 0.5);
  spread.begin(2 * height, height);
  CHECK(spread.empty());
  spread.lay(bead(10, 10, 20, 10, 0.5), 0.5);
  CHECK(sums(spread.raster()).volume == Approx(10 * 0.5 * height));
}

TEST_CASE("a bead between two rows of pixels lies between them") {
  const double aside = GENERATE(-0.5, -0.4, 0.4, 0.49) * pixel;
  const bool upright = GENERATE(false, true);
  CAPTURE(aside / pixel, upright);
  // The middle of a pixel, and nearly half a pixel beside it.
  const double middle = 10 + pixel / 2, at = middle + aside;
  Spread spread({60, 60}, pixel, 3);
  spread.begin(height, height);
  spread.lay(upright ? bead(at, 10, at, 20, 0.4) : bead(10, at, 20, at, 0.4), 0.4);
  const auto before = [&](double line) {
    return upright ? sums(spread.raster(), -1e9, 12, line, 18) : sums(spread.raster(), 12, -1e9, 18, line);
  };
  // Half of it lies before its middle, with pixels counted by their middles.
  const double half = before(1e9).volume / 2, edge = middle - pixel / 2;
  CHECK(before(edge).volume + (at - edge) * 6 * height == Approx(half).margin(0.15 * pixel * 6 * height));
}

TEST_CASE("the pixels of a big bed are coarser, so that a layer's memory stays bounded") {
  CHECK(Spread({200, 200}, 0.05, 3).pixel() == 0.05);
  const double coarse = Spread({1000, 1000}, 0.05, 3).pixel();
  CHECK(1020 * 1020 / (coarse * coarse) <= 20.1e6);
}

TEST_CASE("layers are read from the stream as they were written") {
  const Folder folder;
  const auto file = folder.path() / "rasters";
  std::vector<double> volumes;
  {
    RasterWriter writer(file);
    Spread spread({50, 50}, 0.1, 3);
    Deposit deposit({nullptr, &spread, &writer});
    for (const double z : {0.2, 0.4, 0.7}) {
      Bead laid = bead(10, 10, 10 + 20 * z, 20, 0.5, {0.25, 0.75});
      laid.from.z = laid.to.z = z;
      deposit.laid(laid);
      volumes.push_back(laid.volume);
    }
    deposit.finish();
  }
  RasterReader reader(::open(file.c_str(), O_RDONLY));
  std::size_t layers = 0;
  while (const auto frame = reader.next()) {
    double volume = 0;
    std::vector<RasterPixel> row(frame->columns);
    for (std::uint64_t y = 0; y < frame->rows; ++y) {
      reader.read_row(row);
      for (const RasterPixel& p : row) {
        volume += p.fill * frame->pixel_area() * frame->height;
        if (p.fill > 0) CHECK(p.share(1) == Approx(0.75).margin(1e-4));
      }
    }
    CHECK(volume == Approx(volumes.at(layers)).epsilon(1e-6));
    ++layers;
  }
  CHECK(layers == 3);
}

TEST_CASE("a truncated stream, or one of another format, is refused") {
  const Folder folder;
  const auto file = folder.path() / "rasters";
  {
    RasterWriter writer(file);
    Spread spread({50, 50}, 0.1, 3);
    spread.begin(height, height);
    spread.lay(bead(10, 10, 20, 10, 0.5), 0.5);
    writer.layer(spread.raster());
  }
  const auto read_all = [&] {
    RasterReader reader(::open(file.c_str(), O_RDONLY));
    const auto frame = reader.next();
    std::vector<RasterPixel> row(frame->columns);
    for (std::uint64_t y = 0; y < frame->rows; ++y) reader.read_row(row);
  };
  CHECK_NOTHROW(read_all());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 5);
  CHECK_THROWS_AS(read_all(), RasterError);
  std::filesystem::resize_file(file, 10);
  CHECK_THROWS_AS(read_all(), RasterError);
  std::FILE* other = std::fopen(file.c_str(), "w");
  for (int i = 0; i < 100; ++i) std::fputs("something else ", other);
  std::fclose(other);
  CHECK_THROWS_AS(read_all(), RasterError);
}
