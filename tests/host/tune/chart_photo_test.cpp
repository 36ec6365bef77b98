// A chart that a simulated printer lays, seen by a camera with a wrong white balance, another contrast,
// noise, and light that falls from one side: `tune colours --photo` finds how its filaments mix.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/picture/image.hpp"
#include "tests/host/support/colour_studio.hpp"

namespace unicursal {
namespace {

using picture::Light;
using test::ColourStudio;
using test::Dye;
using test::Outcome;
using test::run;

/// The bed with the chart from above, in even light; every third pixel of the raster.
class PrintedChart {
 public:
  PrintedChart(const std::string& rasters, const test::OtherOptics& optics) {
    constexpr std::uint64_t step = 3;
    std::map<std::vector<int>, Light> known;
    sim::RasterReader reader(::open(rasters.c_str(), O_RDONLY | O_CLOEXEC));
    while (const auto frame = reader.next()) {
      if (lights_.empty()) {
        left_ = frame->left, bottom_ = frame->bottom, pixel_ = frame->pixel * step;
        columns_ = frame->columns / step, rows_ = frame->rows / step;
        lights_.assign(columns_ * rows_, bed);
      }
      std::vector<sim::RasterPixel> pixels(frame->columns);
      for (std::uint64_t row = 0; row < frame->rows; ++row) {
        reader.read_row(pixels);
        if (row % step != 0) continue;
        const double y = frame->bottom + double(row) * frame->pixel;
        const auto to_row = std::size_t(std::lround((y - bottom_) / pixel_));
        for (std::uint64_t column = 0; column < frame->columns && to_row < rows_; column += step) {
          if (pixels[column].fill < 0.5F) continue;
          const double x = frame->left + double(column) * frame->pixel;
          const double to_column = std::round((x - left_) / pixel_);
          if (to_column < 0 || to_column >= double(columns_)) continue;
          lights_[to_row * columns_ + std::size_t(to_column)] = light_of(pixels[column], optics, known);
        }
      }
    }
  }

  Light at(double x, double y) const {
    const double column = (x - left_) / pixel_, row = (y - bottom_) / pixel_;
    if (column < 0 || row < 0 || column >= double(columns_) || row >= double(rows_)) return bed;
    return lights_[std::size_t(row) * columns_ + std::size_t(column)];
  }

 private:
  static constexpr Light bed{0.75, 0.74, 0.7};

  static Light light_of(const sim::RasterPixel& pixel, const test::OtherOptics& optics,
                        std::map<std::vector<int>, Light>& known) {
    std::vector<int> parts(optics.size());
    for (std::size_t f = 0; f < parts.size(); ++f) parts[f] = int(std::lround(200 * pixel.share(f)));
    const auto found = known.find(parts);
    if (found != known.end()) return found->second;
    std::vector<double> shares;
    for (std::size_t f = 0; f < parts.size(); ++f) shares.push_back(pixel.share(f));
    return known[parts] = optics.light(shares);
  }

  double left_ = 0, bottom_ = 0, pixel_ = 1;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Light> lights_;
};

struct Camera {
  Light gains{1, 1, 1};
  double falloff = 0;   ///< how much darker the far right is than the middle
  double contrast = 1;  ///< exponent
  double turned = 0;    ///< radians
};

picture::Image photo_of(const PrintedChart& print, const core::Box& box, const Camera& camera) {
  constexpr std::size_t width = 1500, height = 900;
  picture::Image image(width, height, {});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.006);
  const core::Vec2 middle = box.center();
  const double scale = 1.3 * std::max(box.size().x(), box.size().y() * double(width) / double(height));
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const double u = (double(column) + 0.5) / width - 0.5;
      const double v = (double(height) / 2 - double(row) - 0.5) / width;
      const double slant = 1 + 0.15 * u - 0.2 * v;
      const double x = scale * u / slant, y = scale * v / slant;
      const double bed_x = middle.x() + x * std::cos(camera.turned) - y * std::sin(camera.turned);
      const double bed_y = middle.y() + x * std::sin(camera.turned) + y * std::cos(camera.turned);
      Light light = print.at(bed_x, bed_y);
      const double fall = std::exp(-camera.falloff * 2 * (bed_x - middle.x()) / box.size().x());
      for (std::size_t c = 0; c < 3; ++c)
        light[c] = std::pow(0.8 * fall * camera.gains[c] * std::max(0.0, light[c]), camera.contrast) +
                   noise(random) * 0.3;
      image.set(column, row, picture::colour_of(light));
    }
  }
  return image;
}

}  // namespace

TEST_CASE("A photo of the chart is enough: colours then come out as wanted", "[tuning][optimised]") {
  ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const std::string rasters = (studio.folder / "rasters").string();
  REQUIRE(run({"tune", "colours", studio.profile, "--simulate", "--rasters", rasters}).code == 0);
  const PrintedChart print(rasters, studio.optics);
  const core::Box box{studio.chart.marks[0], studio.chart.marks[2]};
  const double before = studio.median_miss();
  CHECK(before > 2.5);
  const std::string file = (studio.folder / "chart.png").string();
  for (const Camera& camera :
       {Camera{}, Camera{{0.9, 1, 0.75}, 0.15, 1, 0.1}, Camera{{1, 0.95, 0.8}, 0.1, 1.12, 2.8}}) {
    CAPTURE(camera.falloff, camera.contrast);
    studio.folder.write("diamond.toml", studio.text);
    picture::write_png(file, photo_of(print, box, camera));
    const Outcome tuned = run({"tune", "colours", studio.profile, "--photo", file, "--yes"});
    INFO(tuned.out << tuned.err);
    REQUIRE(tuned.code == 0);
    CHECK(studio.median_miss() < 2);
    // The colours of the filaments alone are those that the profile names.
    CHECK(host::load_profile(studio.profile).filaments.of_feeders[0].colour ==
          picture::colour_of(studio.optics.pure(0)));
  }
}

TEST_CASE("A photo whose patches are elsewhere is refused, and the profile stays", "[tuning][optimised]") {
  const ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const std::string rasters = (studio.folder / "rasters").string();
  REQUIRE(run({"tune", "colours", studio.profile, "--simulate", "--rasters", rasters}).code == 0);
  const PrintedChart print(rasters, studio.optics);
  const core::Box box{studio.chart.marks[0], studio.chart.marks[2]};
  const std::string file = (studio.folder / "chart.png").string();
  picture::write_png(file, photo_of(print, box, {}));
  // Corners half a patch beside the marks. The inverse of photo_of().
  std::string corners;
  const double scale = 1.3 * std::max(box.size().x(), box.size().y() * 1500 / 900);
  for (std::size_t i = 0; i < 4; ++i) {
    const core::Vec2 at = (studio.chart.marks[i] + core::Vec2(7, 0) - box.center()) / scale;
    const double slant = 1 / (1 - 0.15 * at.x() + 0.2 * at.y());
    corners += (i > 0 ? "," : "") + std::to_string((at.x() * slant + 0.5) * 1500) + "," +
               std::to_string(450 - at.y() * slant * 1500);
  }
  const Outcome refused =
      run({"tune", "colours", studio.profile, "--photo", file, "--corners", corners, "--yes"});
  INFO(refused.out << refused.err);
  CHECK(refused.code == 2);
  CHECK(refused.err.find("another chart") != std::string::npos);
  CHECK(test::read_text(studio.profile) == studio.text);
}

TEST_CASE("A photo that does not show the chart is refused, and the profile stays", "[tuning]") {
  ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const picture::Image wall(400, 300, {90, 120, 130});
  const std::string file = (studio.folder / "wall.png").string();
  picture::write_png(file, wall);
  const Outcome refused = run({"tune", "colours", studio.profile, "--photo", file, "--yes"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("round marks") != std::string::npos);
  CHECK(run({"tune", "colours", studio.profile, "--photo", file, "--measured", file}).code == 2);
  CHECK(run({"tune", "colours", studio.profile, "--corners", "1,2,3"}).code == 2);
  CHECK(run({"tune", "colours", studio.profile, "--photo", file, "--corners", "1,2,3"}).code == 2);
  CHECK(test::read_text(studio.profile) == studio.text);
}

}  // namespace unicursal
