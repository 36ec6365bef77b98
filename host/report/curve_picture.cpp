#include "host/report/curve_picture.hpp"

#include <algorithm>
#include <utility>

namespace unicursal::host {
namespace {

constexpr double longest_side = 1600;  // pixels
constexpr double pixels_per_bead = 8;  // enough to see the line and the gap beside it
constexpr double line_share = 0.55;    // of the bead width that the line takes
constexpr picture::Colour background{255, 255, 255};
constexpr picture::Colour inside{238, 238, 234};
constexpr picture::Colour border{120, 120, 120};

Canvas empty_canvas(const CurveStyle& style) {
  return {{style.extent, scale_for(style.extent, style.bead_width, pixels_per_bead, longest_side)},
          background};
}

}  // namespace

void draw_path(Canvas& canvas, const core::BeadPath& path, const CurveStyle& style) {
  const double thickness = std::max(1.0, line_share * style.bead_width * canvas.scale());
  for (std::size_t i = 0; i < path.size(); ++i)
    canvas.line(path.start(i), path.end(i), thickness, style.zone_colours.at(path.beads[i].zone));
}

PicturePlace place_of_curves(const CurveStyle& style) {
  const Canvas canvas = empty_canvas(style);
  return {canvas.origin(), 1 / canvas.scale()};
}

picture::Image draw_curves(const PlannedLayer& layer, const CurveStyle& style) {
  Canvas canvas = empty_canvas(style);
  for (const core::Island& island : layer.layer.islands) canvas.fill(island.outline, inside);
  for (const core::Island& island : layer.layer.islands) canvas.outline(island.outline, 1, border);
  for (const core::IslandPlan& plan : layer.plans) {
    for (const core::PlannedCurve& curve : plan.curves) draw_path(canvas, curve.path, style);
  }
  return std::move(canvas.image());
}

}  // namespace unicursal::host
