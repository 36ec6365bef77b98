#include "host/report/target.hpp"

#include "firmware_gcode/toolpath/prime_line.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"

namespace unicursal::host {
namespace {

void move(core::Polygon& polygon, const core::Vec2& offset) {
  for (core::Vec2& vertex : polygon.outer) vertex += offset;
  for (core::Ring& hole : polygon.holes) {
    for (core::Vec2& vertex : hole) vertex += offset;
  }
}

/// Adds the places of the skirt and the prime line.
void add_aside(TargetLayer& target, const PreparedJob& prepared, const gcode::PlacedLayer& placed) {
  const gcode::Printer& printer = prepared.job.profile.printer;
  core::Box kept_clear = prepared.frame.extent;
  const double reach = gcode::skirt_reach(prepared.job.print.skirt, printer);
  kept_clear.min -= core::Vec2(reach, reach);
  kept_clear.max += core::Vec2(reach, reach);
  if (const auto line = gcode::prime_line(printer, kept_clear, target.height)) {
    target.prime.push_back({line->from, line->to, line->width});
  }
  for (const core::BeadPath& ring : gcode::skirt(placed, prepared.job.print.skirt, printer)) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      target.skirt.push_back({ring.start(i), ring.end(i), ring.width(i)});
    }
  }
}

}  // namespace

TargetLayer target_of(const PreparedJob& prepared, const PlannedLayer& planned,
                      const gcode::PlacedLayer& placed) {
  TargetLayer target;
  target.index = planned.layer.index;
  target.top = planned.layer.top - prepared.lowered;
  target.height = planned.layer.height;
  for (const core::Island& island : planned.layer.islands) {
    for (const core::ZoneRegion& region : island.zones) {
      const auto label = static_cast<RegionLabel>(prepared.part->zones().at(region.zone).material);
      for (core::Polygon polygon : region.polygons) {
        move(polygon, prepared.offset);
        target.zones.push_back({std::move(polygon), label});
      }
    }
  }
  target.bead_width = prepared.job.bead_width;
  if (planned.layer.index == prepared.first) add_aside(target, prepared, placed);
  return target;
}

std::vector<IntendedMaterial> intended_materials(const PreparedJob& prepared, const gcode::Encoder& encoder) {
  std::vector<IntendedMaterial> intended;
  for (std::size_t i = 0; i < prepared.job.print.materials.size(); ++i) {
    IntendedMaterial material(encoder.intended(i));
    material.gradient = prepared.job.print.materials[i].gradient;
    if (material.gradient) material.gradient->to = encoder.intended(i, 1);
    material.transition = prepared.job.print.materials[i].transition;
    intended.push_back(std::move(material));
  }
  return intended;
}

CurveStyle curve_style(const PreparedJob& prepared) {
  CurveStyle style;
  style.extent = prepared.part->extent();
  const picture::Filaments filaments = prepared.job.profile.filaments.colours();
  for (const core::Zone& zone : prepared.part->zones()) {
    const gcode::Mixture& mixture = prepared.job.print.materials.at(zone.material).mixture;
    style.zone_colours.push_back(picture::colour_of(mixture.shares(), filaments));
  }
  style.bead_width = prepared.job.bead_width;
  return style;
}

}  // namespace unicursal::host
