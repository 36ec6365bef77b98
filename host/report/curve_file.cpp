#include "host/report/curve_file.hpp"

#include <fmt/format.h>

#include <iterator>

#include "core/error.hpp"
#include "core/picture/hex_colour.hpp"
#include "host/files/whole_file.hpp"

namespace unicursal::host {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Transforms from the part's frame to a drawing whose viewBox begins at 0 0.
struct SvgFrame {
  core::Box extent;

  core::Vec2 operator()(const core::Vec2& p) const {
    return {p.x() - extent.min.x(), extent.max.y() - p.y()};
  }
};

void append_ring(Text out, const SvgFrame& frame, const core::Ring& ring) {
  const char* command = "M";
  for (const core::Vec2& point : ring) {
    const core::Vec2 p = frame(point);
    fmt::format_to(out, "{}{:.4f} {:.4f}", command, p.x(), p.y());
    command = " L";
  }
  fmt::format_to(out, " Z ");
}

void append_outline(Text out, const SvgFrame& frame, const core::Polygon& outline) {
  fmt::format_to(
      out, "<path fill=\"#eeeeea\" stroke=\"#787878\" stroke-width=\"0.05\" fill-rule=\"evenodd\" d=\"");
  append_ring(out, frame, outline.outer);
  for (const core::Ring& hole : outline.holes) append_ring(out, frame, hole);
  fmt::format_to(out, "\"/>\n");
}

/// One polyline for each run of beads of the same zone, so that colours change where zones do.
void append_curve(Text out, const SvgFrame& frame, const core::BeadPath& path, const CurveStyle& style) {
  for (std::size_t i = 0; i < path.size();) {
    const std::size_t zone = path.beads[i].zone;
    core::Vec2 p = frame(path.start(i));
    fmt::format_to(out,
                   "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3f}\" stroke-linejoin=\"round\" "
                   "d=\"M{:.4f} {:.4f}",
                   picture::hex_of(style.zone_colours.at(zone)), style.bead_width * 0.55, p.x(), p.y());
    for (; i < path.size() && path.beads[i].zone == zone; ++i) {
      p = frame(path.end(i));
      fmt::format_to(out, " L{:.4f} {:.4f}", p.x(), p.y());
    }
    fmt::format_to(out, "\"/>\n");
  }
}

}  // namespace

std::string curve_text(const core::IslandPlan& plan) {
  std::string text;
  for (const core::PlannedCurve& curve : plan.curves) {
    if (!text.empty()) text += '\n';
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      const core::Vec2& p = curve.path.start(i);
      fmt::format_to(std::back_inserter(text), "{} {} {}\n", p.x(), p.y(), curve.path.width(i));
    }
  }
  return text;
}

std::string curve_svg(const PlannedLayer& layer, const CurveStyle& style) {
  const core::Vec2 size = style.extent.size();
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "width=\"{0:.4f}mm\" "
      "height=\"{1:.4f}mm\" viewBox=\"0 0 {0:.4f} {1:.4f}\">\n",
      size.x(), size.y());
  const auto out = std::back_inserter(text);
  const SvgFrame frame{style.extent};
  for (const core::Island& island : layer.layer.islands) append_outline(out, frame, island.outline);
  for (const core::IslandPlan& plan : layer.plans) {
    for (const core::PlannedCurve& curve : plan.curves) append_curve(out, frame, curve.path, style);
  }
  return text + "</svg>\n";
}

void check_curve_file(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".txt" || ending == ".svg" || ending == ".png") return;
  throw core::DataError(file.string(), "", "has an ending that no curve is written in",
                        "choose .txt, .svg or .png");
}

void write_curve(const std::filesystem::path& file, const PlannedLayer& layer, const CurveStyle& style) {
  check_curve_file(file);
  const std::string ending = file.extension().string();
  if (ending == ".png") picture::write_png(file, draw_curves(layer, style));
  if (ending == ".svg") write_whole_file(file, curve_svg(layer, style));
  if (ending != ".txt") return;
  std::string text;
  for (const core::IslandPlan& plan : layer.plans) text += curve_text(plan);
  write_whole_file(file, text);
}

}  // namespace unicursal::host
