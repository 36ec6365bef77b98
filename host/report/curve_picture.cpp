#include "host/report/curve_picture.hpp"

#include <algorithm>
#include <cmath>

#include "core/picture/filaments.hpp"

namespace unicursal::host {
namespace {

constexpr double longest_side = 1600;  // pixels
constexpr double pixels_per_bead = 8;  // enough to see the line and the gap beside it
constexpr double margin = 8;           // pixels
constexpr double line_share = 0.55;    // of the bead width that the line takes
constexpr picture::Colour background{255, 255, 255};
constexpr picture::Colour inside{238, 238, 234};
constexpr picture::Colour border{120, 120, 120};

/// From the part's frame to pixels.
struct View {
  core::Vec2 origin;  ///< mm, at the picture's lower left
  double scale;       ///< pixels per mm
  double height;      ///< pixels

  core::Vec2 operator()(const core::Vec2& p) const {
    const core::Vec2 q = (p - origin) * scale;
    return {q.x(), height - q.y()};
  }
};

double scale_for(const CurveStyle& style) {
  const double size = std::max(style.extent.size().maxCoeff(), style.bead_width);
  return std::min(pixels_per_bead / style.bead_width, longest_side / size);
}

/// Even-odd scan conversion of all rings of the polygon, at pixel centres.
void fill(picture::Image& image, const View& view, const core::Polygon& polygon) {
  std::vector<double> crossings;
  const auto collect = [&](const core::Ring& ring, double y) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const core::Vec2 a = view(ring[i]), b = view(ring[(i + 1) % ring.size()]);
      if ((a.y() <= y) != (b.y() <= y))
        crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  };
  for (std::size_t row = 0; row < image.height(); ++row) {
    crossings.clear();
    const double y = static_cast<double>(row) + 0.5;
    collect(polygon.outer, y);
    for (const core::Ring& hole : polygon.holes) collect(hole, y);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const double from = std::max(0.0, std::ceil(crossings[i] - 0.5));
      const double to = std::min(static_cast<double>(image.width()) - 1, std::floor(crossings[i + 1] - 0.5));
      for (double x = from; x <= to; ++x) image.set(static_cast<std::size_t>(x), row, inside);
    }
  }
}

void draw_ring(picture::Image& image, const View& view, const core::Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const core::Vec2 a = view(ring[i]), b = view(ring[(i + 1) % ring.size()]);
    image.stroke(a.x(), a.y(), b.x(), b.y(), 1, border);
  }
}

void draw_path(picture::Image& image, const View& view, const core::BeadPath& path, const CurveStyle& style) {
  const double thickness = std::max(1.0, line_share * style.bead_width * view.scale);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const core::Vec2 a = view(path.start(i)), b = view(path.end(i));
    image.stroke(a.x(), a.y(), b.x(), b.y(), thickness, style.zone_colours.at(path.beads[i].zone));
  }
}

}  // namespace

picture::Colour colour_of(const gcode::Mixture& mixture) {
  return picture::mixed_filaments(mixture.shares());
}

picture::Image draw_curves(const PlannedLayer& layer, const CurveStyle& style) {
  const double scale = scale_for(style);
  const core::Vec2 size = style.extent.size() * scale + core::Vec2::Constant(2 * margin);
  const core::Vec2 origin = style.extent.min - core::Vec2::Constant(margin / scale);
  picture::Image image(static_cast<std::size_t>(std::ceil(size.x())),
                       static_cast<std::size_t>(std::ceil(size.y())), background);
  const View view{origin, scale, static_cast<double>(image.height())};
  for (const core::Island& island : layer.layer.islands) fill(image, view, island.outline);
  for (const core::Island& island : layer.layer.islands) {
    draw_ring(image, view, island.outline.outer);
    for (const core::Ring& hole : island.outline.holes) draw_ring(image, view, hole);
  }
  for (const core::IslandPlan& plan : layer.plans) {
    for (const core::PlannedCurve& curve : plan.curves) draw_path(image, view, curve.path, style);
  }
  return image;
}

}  // namespace unicursal::host
