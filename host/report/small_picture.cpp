#include "host/report/small_picture.hpp"

#include <algorithm>
#include <fstream>
#include <utility>
#include <variant>

#include "core/stopping.hpp"
#include "firmware_gcode/sliced/reader.hpp"
#include "host/report/target.hpp"

namespace unicursal::host {
namespace {

constexpr double longest_small_side = 490;    // pixels, within the canvas's margin
constexpr double most_pixels_per_width = 40;  // of one bead
constexpr std::size_t most_lines_drawn = 200'000;
constexpr picture::Colour small_background{255, 255, 255};
constexpr picture::Colour small_border{120, 120, 120};

/// A stretch of a slicer's line.
struct LaidLine {
  core::Vec2 from{0, 0}, to{0, 0};
  picture::Colour colour;
};

Canvas small_canvas(const core::Box& extent, double bead_width) {
  const double scale = scale_for(extent, bead_width, most_pixels_per_width, longest_small_side);
  return Canvas({extent, scale}, small_background);
}

void include(std::optional<core::Box>& box, const core::Vec2& point) {
  if (!box) box = core::Box{point, point};
  box->min = box->min.cwiseMin(point);
  box->max = box->max.cwiseMax(point);
}

std::optional<LaidLine> laid_line(const gcode::SlicedMove& move, picture::Colour colour) {
  if (!move.lays() || !move.from[0] || !move.from[1] || !move.to[0] || !move.to[1]) return std::nullopt;
  return LaidLine{{*move.from[0], *move.from[1]}, {*move.to[0], *move.to[1]}, colour};
}

/// The first layer that lays anything.
std::vector<LaidLine> first_lines(const PreparedSliced& prepared) {
  const Job& job = prepared.job;
  const picture::Filaments filaments = job.profile.filaments.colours();
  const auto colour_of_tool = [&](int tool) {
    const auto material = job.sliced->tools.find(tool);
    if (material == job.sliced->tools.end()) return small_border;
    return picture::colour_of(job.print.materials.at(material->second).mixture.shares(), filaments);
  };
  std::ifstream file(prepared.file(), std::ios::binary);
  gcode::SlicedReader reader(file, prepared.file().string(), job.profile.printer,
                             remix_settings(prepared).limits, prepared.survey.marked);
  picture::Colour colour = colour_of_tool(0);
  std::vector<LaidLine> lines;
  while (const auto step = reader.next()) {
    core::stop_point();
    if (std::holds_alternative<gcode::SlicedLayer>(*step) && !lines.empty()) break;
    if (const auto* change = std::get_if<gcode::SlicedToolChange>(&*step))
      colour = colour_of_tool(change->tool);
    const auto* move = std::get_if<gcode::SlicedMove>(&*step);
    const auto line = move ? laid_line(*move, colour) : std::nullopt;
    if (line) lines.push_back(*line);
    if (lines.size() >= most_lines_drawn) break;
  }
  return lines;
}

}  // namespace

picture::Image small_picture(const PreparedJob& prepared) {
  const core::Layer layer = prepared.part->layer(prepared.first);
  const CurveStyle style = curve_style(prepared);
  std::optional<core::Box> extent;
  for (const core::Island& island : layer.islands) {
    for (const core::Vec2& point : island.outline.outer) include(extent, point);
  }
  Canvas canvas = small_canvas(extent.value_or(style.extent), style.bead_width);
  for (const core::Island& island : layer.islands) {
    for (const core::ZoneRegion& region : island.zones) {
      core::stop_point();
      for (const core::Polygon& polygon : region.polygons)
        canvas.fill(polygon, style.zone_colours.at(region.zone));
    }
    canvas.outline(island.outline, 1.5, small_border);
  }
  return std::move(canvas.image());
}

picture::Image small_picture(const gcode::PlacedLayer& layer, const CurveStyle& style) {
  std::optional<core::Box> extent;
  for (const core::BeadPath& path : layer.paths) {
    for (const core::Bead& bead : path.beads) include(extent, bead.position);
  }
  Canvas canvas = small_canvas(extent.value_or(style.extent), style.bead_width);
  for (const core::BeadPath& path : layer.paths) draw_path(canvas, path, style);
  return std::move(canvas.image());
}

picture::Image small_picture(const PreparedSliced& prepared) {
  const std::vector<LaidLine> lines = first_lines(prepared);
  std::optional<core::Box> extent;
  for (const LaidLine& line : lines) {
    include(extent, line.from);
    include(extent, line.to);
  }
  const double nozzle = prepared.job.profile.printer.nozzle;
  Canvas canvas = small_canvas(extent.value_or(prepared.survey.extent), nozzle);
  const double thickness = std::max(1.0, 0.8 * nozzle * canvas.scale());
  for (const LaidLine& line : lines) canvas.line(line.from, line.to, thickness, line.colour);
  return std::move(canvas.image());
}

}  // namespace unicursal::host
