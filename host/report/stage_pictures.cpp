#include "host/report/stage_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/curve/evenness.hpp"
#include "core/picture/text.hpp"

namespace unicursal::host {
namespace {

using picture::Colour;

// Pixels unless the unit is a bead width.
constexpr double pixels_per_bead = 14, longest_side = 1800;
constexpr double least_width = 420, caption_room = 34;
constexpr double caption_left = 10;
constexpr std::size_t text_dot = 3;
constexpr double stroke_length = 1.05;  ///< of the field, bead widths
constexpr double thin_line = 1.2, thick_line = 2.4;
constexpr double wide_bead = 0.72;      ///< bead widths, of the line in the picture of widths
constexpr double paleness = 0.72;       ///< share of white below lines
constexpr double most_deviation = 0.5;  ///< of the bead width; beyond it colours stay the same

constexpr Colour paper{255, 255, 255}, ink{46, 48, 56}, faint{176, 178, 186}, border{110, 110, 116};
constexpr Colour needle_ink{196, 60, 52}, night{38, 40, 48};
constexpr Colour narrow{44, 110, 214}, as_asked{244, 242, 236}, wide{222, 62, 48};

Colour blend(Colour a, Colour b, double share) {
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// All pictures of one story: the island, and a caption below.
class Painter {
 public:
  Painter(const IslandStory& story, const CurveStyle& style) : story_(story), style_(style) {
    const core::Box extent = core::bounds(story.island.outline);
    size_ = {extent, scale_for(extent, style.bead_width, pixels_per_bead, longest_side), least_width,
             caption_room};
  }

  picture::Image field() const {
    Canvas canvas = zones("1 field");
    const double half = stroke_length * style_.bead_width / 2;
    for (const core::AskedDirection& here : story_.stages.field) {
      const core::Vec2 along = here.angle
                                   ? core::Vec2(half * std::cos(*here.angle), half * std::sin(*here.angle))
                                   : core::Vec2(0, 0);
      canvas.line(here.point - along, here.point + along, thick_line, ink);
    }
    return std::move(canvas.image());
  }

  picture::Image graph() const {
    Canvas canvas = zones("2 graph");
    for (const core::CycleStages& stages : story_.stages.cycles) {
      draw_lines(canvas, stages.edges, thin_line, ink);
      draw_lines(canvas, stages.needles, thick_line, needle_ink);
    }
    return std::move(canvas.image());
  }

  picture::Image first_cycle() const { return cycle("3 first cycle", &core::CycleStages::first); }
  picture::Image optimised_cycle() const { return cycle("4 optimised cycle", &core::CycleStages::optimised); }

  picture::Image curve() const {
    Canvas canvas = zones("5 curve");
    for (const core::PlannedCurve& curve : story_.plan.curves) draw_path(canvas, curve.path, style_);
    return std::move(canvas.image());
  }

  picture::Image widths() const {
    Canvas canvas = captioned("6 width");
    canvas.fill(story_.island.outline, night);
    const double thickness = std::max(1.0, wide_bead * style_.bead_width * canvas.scale());
    for (const core::PlannedCurve& curve : story_.plan.curves) {
      const std::vector<double> widths = core::widths_around(curve.path, style_.bead_width);
      for (std::size_t i = 0; i < widths.size(); ++i)
        canvas.line(curve.path.start(i), curve.path.end(i), thickness,
                    width_colour(widths[i] / style_.bead_width));
    }
    draw_scale(canvas);
    return std::move(canvas.image());
  }

 private:
  Canvas captioned(std::string_view caption) const {
    Canvas canvas(size_, paper);
    write(canvas, caption_left, caption);
    return canvas;
  }

  /// The zones in paler colours than their beads'.
  Canvas zones(std::string_view caption) const {
    Canvas canvas = captioned(caption);
    for (const core::ZoneRegion& region : story_.island.zones) {
      const Colour colour = blend(style_.zone_colours.at(region.zone), paper, paleness);
      for (const core::Polygon& polygon : region.polygons) canvas.fill(polygon, colour);
    }
    canvas.outline(story_.island.outline, thin_line, border);
    return canvas;
  }

  /// A closed line over its graph.
  picture::Image cycle(std::string_view caption, core::Ring core::CycleStages::*which) const {
    Canvas canvas = zones(caption);
    for (const core::CycleStages& stages : story_.stages.cycles) {
      draw_lines(canvas, stages.edges, thin_line, faint);
      canvas.ring(stages.*which, thick_line, ink);
    }
    return std::move(canvas.image());
  }

  static void draw_lines(Canvas& canvas, const std::vector<core::Polyline>& lines, double thickness,
                         Colour colour) {
    for (const core::Polyline& line : lines) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i) canvas.line(line[i], line[i + 1], thickness, colour);
    }
  }

  static void write(Canvas& canvas, double left, std::string_view words) {
    const auto height = static_cast<std::ptrdiff_t>(canvas.image().height());
    constexpr auto text_height = static_cast<std::ptrdiff_t>(text_dot * picture::glyph_height);
    picture::write(canvas.image(), static_cast<std::ptrdiff_t>(left), height - text_height - 10, words,
                   text_dot, ink);
  }

  /// The scale of widths, with ratios at its ends and in the middle.
  static void draw_scale(Canvas& canvas) {
    constexpr double bar = 120, glyph = text_dot * picture::glyph_width;
    const double left = static_cast<double>(canvas.image().width()) - bar - 4 * glyph - caption_left;
    const double y = static_cast<double>(canvas.image().height()) - 18;
    for (double x = 0; x < bar; ++x) {
      const double ratio = 1 + most_deviation * (2 * x / bar - 1);
      canvas.image().stroke(left + x, y - 7, left + x, y + 7, 1.5, width_colour(ratio));
    }
    write(canvas, left - 4 * glyph, "0.5");
    write(canvas, left + bar + glyph, "1.5");
  }

  const IslandStory& story_;
  const CurveStyle& style_;
  CanvasSize size_;
};

}  // namespace

Colour width_colour(double ratio) {
  const double deviation = std::clamp((ratio - 1) / most_deviation, -1.0, 1.0);
  return blend(as_asked, deviation < 0 ? narrow : wide, std::abs(deviation));
}

void write_stage_pictures(const std::filesystem::path& folder, const IslandStory& story,
                          const CurveStyle& style) {
  const Painter painter(story, style);
  picture::write_png(folder / "1-field.png", painter.field());
  picture::write_png(folder / "2-graph.png", painter.graph());
  picture::write_png(folder / "3-first-cycle.png", painter.first_cycle());
  picture::write_png(folder / "4-optimised-cycle.png", painter.optimised_cycle());
  picture::write_png(folder / "5-curve.png", painter.curve());
  picture::write_png(folder / "6-width.png", painter.widths());
}

}  // namespace unicursal::host
