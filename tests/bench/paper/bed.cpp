#include "tests/bench/paper/bed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/picture/filaments.hpp"
#include "core/picture/image.hpp"
#include "host/report/deposit_judge.hpp"
#include "sim/bed/deposit.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;
using core::Vec2;

constexpr double raster_pixel = 0.05;
constexpr std::size_t white = 2, green = 4;  ///< among the usual filaments
constexpr double around_part = 3;            ///< mm
constexpr double longest_picture = 1100;     ///< pixels
constexpr double finest_pixel = 0.03;        ///< mm

core::Box box_of(const Part& part) {
  std::vector<Polygon> outlines;
  for (const core::Island& island : part.layer.islands) outlines.push_back(island.outline);
  return core::bounds(outlines);
}

core::Ring moved(const core::Ring& ring, const Vec2& by) {
  core::Ring result = ring;
  for (Vec2& p : result) p += by;
  return result;
}

class Judge : public sim::RasterSink {
 public:
  Judge(const Part& part, const Vec2& offset) {
    target_.top = part.layer.height;
    target_.height = part.layer.height;
    target_.bead_width = part.width();
    for (const core::Island& island : part.layer.islands) {
      Polygon polygon{moved(island.outline.outer, offset), {}};
      for (const core::Ring& hole : island.outline.holes) polygon.holes.push_back(moved(hole, offset));
      target_.zones.push_back({std::move(polygon), 0});
    }
  }
  void layer(const sim::LayerRaster& raster) override {
    std::uint64_t row = 0;
    const auto rows = [&](std::span<sim::RasterPixel> pixels) { raster.read_row(row++, pixels); };
    judged = host::judge(target_, raster.frame(), rows, {gcode::Mixture::equal(1)}, true);
  }

  std::optional<host::JudgedLayer> judged;

 private:
  host::TargetLayer target_;
};

/// `width`: of every bead; nullopt: each segment gets its own area.
std::optional<host::JudgedLayer> laid(const Part& part, const Run& run,
                                      const std::vector<std::vector<double>>& areas,
                                      const std::optional<double>& width) {
  const core::Box box = box_of(part);
  const Vec2 offset = Vec2::Constant(around_part) - box.min,
             size = box.size() + 2 * Vec2::Constant(around_part);
  const double height = part.layer.height;
  Judge judge(part, offset);
  sim::Spread spread({size.x(), size.y()}, raster_pixel, 1);
  sim::Deposit deposit({nullptr, &spread, &judge});
  const auto place = [&](const Vec2& p) {
    return sim::Position{p.x() + offset.x(), p.y() + offset.y(), height};
  };
  std::optional<Vec2> at;
  for (std::size_t k = 0; k < run.islands.size(); ++k) {
    const double* area = areas[k].data();
    for (const Line& line : run.islands[k].lines) {
      if (at) deposit.travelled(place(*at), place(line.points.front()));
      for (std::size_t i = 0; i < line.segments(); ++i, ++area) {
        const double length = line.length(i);
        if (!(length > 0)) continue;
        sim::Bead bead{place(line.start(i)), place(line.end(i)), 0, {}, 0, length};
        bead.volume = height * (width ? *width * length : *area);
        bead.shares[0] = 1;
        deposit.laid(bead);
        at = line.end(i);
      }
    }
  }
  deposit.finish();
  return std::move(judge.judged);
}

/// The lines in one colour, travels in red, zones in pale colours.
picture::Image drawing(const Part& part, const Run& run) {
  const core::Box box = box_of(part);
  const Vec2 size = box.size() + Vec2::Constant(2);
  const double pixel = std::max(finest_pixel, size.maxCoeff() / longest_picture);
  const auto pixels = [&](double mm) { return static_cast<std::size_t>(std::ceil(mm / pixel)); };
  picture::Image image(pixels(size.x()), pixels(size.y()), {255, 255, 255});
  const auto to = [&](const Vec2& p) {
    return Vec2((p.x() - box.min.x() + 1) / pixel, (box.max.y() - p.y() + 1) / pixel);
  };
  std::vector<host::LabelledPolygon> zones;
  for (const core::Island& island : part.layer.islands) {
    for (const core::ZoneRegion& zone : island.zones) {
      for (const Polygon& polygon : zone.polygons)
        zones.push_back({polygon, static_cast<host::RegionLabel>(zone.zone % 8)});
    }
  }
  const host::PixelGrid grid{{box.min.x() - 1, box.max.y() + 1 - static_cast<double>(image.height()) * pixel},
                             pixel,
                             image.width(),
                             image.height()};
  const std::vector<host::RegionLabel> labels = host::scan(zones, grid);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == host::outside_all) continue;
    // Green stands for white, which would not be seen on the page.
    const picture::Colour zone = picture::usual_filaments[labels[i] == white ? green : labels[i]];
    const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(255 - (255 - c) * 3 / 10); };
    image.set(i % grid.columns, grid.rows - 1 - i / grid.columns, {pale(zone.r), pale(zone.g), pale(zone.b)});
  }
  const double thickness = 0.4 * part.width() / pixel;
  std::optional<Vec2> at;
  for (const Filling& filling : run.islands) {
    at.reset();
    for (const Line& line : filling.lines) {
      for (std::size_t i = 0; i < line.segments(); ++i) {
        const Vec2 a = to(line.start(i)), b = to(line.end(i));
        image.stroke(a.x(), a.y(), b.x(), b.y(), thickness, {40, 44, 52});
      }
    }
    for (const Line& line : filling.lines) {
      if (at) {
        const Vec2 a = to(*at), b = to(line.points.front());
        image.stroke(a.x(), a.y(), b.x(), b.y(), thickness, {220, 30, 40});
      }
      at = line.closed ? line.points.front() : line.points.back();
    }
  }
  return image;
}

Bed bed_of(const host::JudgedLayer& judged) {
  return {judged.findings.gap_fraction(), judged.findings.overfill_fraction()};
}

}  // namespace

void lay_and_draw(const Part& part, const Run& run, const std::vector<std::vector<double>>& areas,
                  const std::filesystem::path& folder, Figures& result) {
  if (!(result.length > 0)) {
    result.constant.gaps = result.own.gaps = 1;
    return;
  }
  const std::string stem = part.name + "-" + run.method;
  if (const auto own = laid(part, run, areas, std::nullopt)) result.own = bed_of(*own);
  if (const auto constant = laid(part, run, areas, part.area() / result.length)) {
    result.constant = bed_of(*constant);
    if (constant->gaps) {
      result.gaps_picture = stem + "-gaps.png";
      picture::write_png(folder / result.gaps_picture, *constant->gaps);
    }
  }
  result.lines_picture = stem + ".png";
  picture::write_png(folder / result.lines_picture, drawing(part, run));
}

}  // namespace unicursal::bench
