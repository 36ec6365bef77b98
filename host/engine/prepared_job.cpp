#include "host/engine/prepared_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/model/read_part.hpp"
#include "host/engine/read_plate.hpp"

namespace unicursal::host {
namespace {

/// Tolerance for rounding when a part fills the bed exactly, mm.
constexpr double fit_tolerance = 1e-6;

core::Vec2 offset_on_bed(const Placement& place, const core::Box& extent, const gcode::Printer& printer) {
  switch (place.kind) {
    case Placement::Kind::as_is:
      return {0, 0};
    case Placement::Kind::at:
      return place.point - extent.center();
    case Placement::Kind::center:
      break;
  }
  return core::Vec2(printer.bed[0], printer.bed[1]) / 2 - extent.center();
}

double first_layer_height(const core::PartSource& source) {
  return source.first_layer_height > 0 ? source.first_layer_height : source.layer_height;
}

/// Height at which a layer begins, mm above the part's underside.
double underside(const core::PartSource& source, std::size_t layer) {
  if (layer == 0) return 0;
  return first_layer_height(source) + static_cast<double>(layer - 1) * source.layer_height;
}

using Size = std::array<double, 3>;  // mm

bool fits(const Size& size, const Size& bed) {
  return size[0] <= bed[0] && size[1] <= bed[1] && size[2] <= bed[2];
}

/// Degrees about x, y and z that make a box fit which does not fit as it is: a turn about z, if possible a
/// quarter or half of one, or laid down.
std::optional<std::array<int, 3>> fitting_turn(const Size& size, const Size& bed, bool may_lie_down) {
  const std::array<std::array<int, 2>, 3> laid{{{0, 0}, {90, 0}, {0, 90}}};
  for (const auto& [about_x, about_y] : laid) {
    if (!may_lie_down && about_x + about_y > 0) break;
    Size lying = size;
    if (about_x > 0) std::swap(lying[1], lying[2]);
    if (about_y > 0) std::swap(lying[0], lying[2]);
    for (const int about_z : {0, 90, 45, 5, 10, 15, 20, 25, 30, 35, 40, 50, 55, 60, 65, 70, 75, 80, 85}) {
      const double angle = about_z * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
      if (fits({c * lying[0] + s * lying[1], s * lying[0] + c * lying[1], lying[2]}, bed))
        return std::array{about_x, about_y, about_z};
    }
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const Job& job, const std::string& place, const std::string& problem,
                         const std::string& remedy) {
  throw JobError(job.file.string(), place, problem, remedy);
}

/// How a part that is too large could be made to fit: in another unit, turned, or smaller.
std::string remedy_of_size(const Job& job, const Size& size) {
  const auto& bed = job.profile.printer.bed;
  const core::PartSource& source = job.source;
  const bool drawing = core::is_drawing_file(source.files.front());
  const bool unitless = std::all_of(source.files.begin(), source.files.end(), core::is_unitless_file);
  std::string upright;
  if (job.shaping.pose.unchanged()) {
    constexpr double microns_from = 10000;  // mm
    if (unitless && *std::max_element(size.begin(), size.end()) >= microns_from &&
        fits({size[0] / 1000, size[1] / 1000, size[2] / 1000}, bed))
      return "write units = \"micron\" if its file is in micrometres";
    if (const auto turn = fitting_turn(size, bed, !drawing)) {
      const auto& [about_x, about_y, about_z] = *turn;
      if (about_x + about_y == 0) return fmt::format("write rotate = {}, with which it fits", about_z);
      const double height = about_x > 0 ? size[1] : size[0];
      const std::string turned = fmt::format("rotate = [{}, {}, {}]", about_x, about_y, about_z);
      if (height <= size[2]) return "write " + turned + ", with which it fits";
      upright = "or " + turned + " to stand it up, ";
    }
  }
  double factor = std::min(bed[0] / size[0], bed[1] / size[1]);
  if (!drawing) factor = std::min(factor, bed[2] / size[2]);
  if (drawing && size[2] > bed[2]) return "lower height, or choose a larger printer with --profile";
  constexpr double steps = 1000;
  factor = std::floor(factor * steps) / steps;
  if (!(factor > 0)) return "check the unit of its file, or choose a larger printer with --profile";
  const char* const larger = "cut the part, or choose a larger printer with --profile";
  if (job.shaping.pose.width > 0)
    return fmt::format("write width = {:.1f}, {}", job.shaping.pose.width * factor, larger);
  if (job.shaping.pose.scale == core::Pose{}.scale)
    return fmt::format("write scale = {:.3g}, {}{}", factor, upright, larger);
  return fmt::format("make the part {:.3g} times as large with scale, {}", factor, larger);
}

void check_fit(const PreparedJob& prepared, double height) {
  const Job& job = prepared.job;
  const auto& bed = job.profile.printer.bed;
  const core::Box extent = prepared.part->extent();
  const core::Vec2 size = extent.size();
  if (!size.allFinite() || size.x() > bed[0] + fit_tolerance || size.y() > bed[1] + fit_tolerance ||
      height > bed[2] + fit_tolerance) {
    refuse(job, "part",
           fmt::format("is {:.1f} x {:.1f} x {:.1f} mm, larger than the bed of {:.1f} x {:.1f} x {:.1f} mm",
                       size.x(), size.y(), height, bed[0], bed[1], bed[2]),
           remedy_of_size(job, {size.x(), size.y(), height}));
  }
  const core::Vec2 low = extent.min + prepared.offset, high = extent.max + prepared.offset;
  if (low.minCoeff() < -fit_tolerance || high.x() > bed[0] + fit_tolerance ||
      high.y() > bed[1] + fit_tolerance) {
    refuse(job, "part.place",
           fmt::format("puts the part at x {:.1f} to {:.1f}, y {:.1f} to {:.1f} mm, beyond the bed of {:.1f} "
                       "x {:.1f} mm",
                       low.x(), high.x(), low.y(), high.y(), bed[0], bed[1]),
           "write place = \"center\", or a point further inside");
  }
}

/// How far the zones of a material reach along a direction, in the part's frame. Only some layers are sliced,
/// since slicing all of a tall part would take long.
std::array<double, 2> reach_of(const PreparedJob& prepared, std::size_t material,
                               const std::array<double, 3>& along) {
  constexpr std::size_t most_slices = 32;
  std::array<double, 2> reach{std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
  const auto include = [&](const core::Vec2& p, double z) {
    const double way = along[0] * p.x() + along[1] * p.y() + along[2] * z;
    reach = {std::min(reach[0], way), std::max(reach[1], way)};
  };
  const std::size_t count = prepared.part->layer_count(), slices = std::min(count, most_slices);
  for (std::size_t i = 0; i < slices; ++i) {
    const core::Layer layer = prepared.part->layer(slices > 1 ? i * (count - 1) / (slices - 1) : 0);
    for (const core::Island& island : layer.islands) {
      for (const core::ZoneRegion& region : island.zones) {
        if (prepared.part->zones()[region.zone].material != material) continue;
        for (const core::Polygon& polygon : region.polygons) {
          for (const core::Vec2& p : polygon.outer)
            include(p, layer.top), include(p, layer.top - layer.height);
        }
      }
    }
  }
  return reach;
}

/// Moves gradients from the part's frame to the bed's.
void place_gradients(PreparedJob& prepared) {
  for (std::size_t i = 0; i < prepared.job.print.materials.size(); ++i) {
    std::optional<gcode::Gradient>& gradient = prepared.job.print.materials[i].gradient;
    if (!gradient) continue;
    if (gradient->begin >= gradient->end) {
      const auto [begin, end] = reach_of(prepared, i, gradient->along);
      gradient->begin = std::isfinite(begin) ? begin : 0;
      gradient->end = end > begin ? end : gradient->begin + 1;
    }
    const double shift = gradient->along[0] * prepared.offset.x() + gradient->along[1] * prepared.offset.y() -
                         gradient->along[2] * prepared.lowered;
    gradient->begin += shift;
    gradient->end += shift;
  }
}

void choose_layers(PreparedJob& prepared, const std::optional<LayerRange>& layers) {
  const std::size_t all = prepared.part->layer_count();
  if (all == 0) refuse(prepared.job, "part", "has no layer", "check height and layer_height");
  const LayerRange range = layers.value_or(LayerRange{0, all - 1});
  if (range.first > range.last || range.first >= all) {
    throw core::DataError("", "--layers",
                          fmt::format("{}:{} names no layer of this part", range.first, range.last),
                          fmt::format("its layers are 0:{}", all - 1));
  }
  prepared.first = range.first;
  prepared.count = std::min(range.last, all - 1) - range.first + 1;
  if (layers && prepared.job.one_by_one && is_plate(prepared.job)) {
    throw core::DataError("", "--layers", "cannot pick layers of parts that are printed one by one",
                          "leave it out, or write order = \"together\" in the job");
  }
  prepared.layers = layers;
  prepared.lowered = underside(prepared.job.source, prepared.first);
}

core::Polygon moved(core::Polygon polygon, const core::Vec2& offset) {
  for (core::Vec2& vertex : polygon.outer) vertex += offset;
  for (core::Ring& hole : polygon.holes) {
    for (core::Vec2& vertex : hole) vertex += offset;
  }
  return polygon;
}

core::BeadPath on_bed(core::BeadPath path, const core::Vec2& offset) {
  for (core::Bead& bead : path.beads) bead.position += offset;
  return path;
}

void thin(core::BeadPath& path, double width) {
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = width * path.length(i);
}

gcode::PrintFrame frame_of(const PreparedJob& prepared) {
  const core::PartSource& source = prepared.job.source;
  gcode::PrintFrame frame;
  frame.layer_height = source.layer_height;
  frame.first_layer_height = prepared.first == 0 ? first_layer_height(source) : source.layer_height;
  frame.layer_count = prepared.count;
  for (const core::Zone& zone : prepared.part->zones()) frame.zone_materials.push_back(zone.material);
  frame.extent = prepared.part->extent();
  frame.extent.min += prepared.offset;
  frame.extent.max += prepared.offset;
  frame.part_height = prepared.part->height() - prepared.lowered;
  return frame;
}

bool has_curve(const PreparedJob& prepared, const core::Layer& layer) {
  const core::PlanOptions plan = lookahead_options(prepared).plan;
  return std::any_of(layer.islands.begin(), layer.islands.end(),
                     [&](const core::Island& island) { return prepared.planner->fits(island, plan); });
}

}  // namespace

PreparedJob prepare(Job job, const std::optional<LayerRange>& layers,
                    const std::function<void(const std::string&)>& note) {
  PreparedJob prepared;
  prepared.job = std::move(job);
  if (note) {
    for (const std::string& warning : prepared.job.warnings) note(warning);
  }
  prepared.part = is_plate(prepared.job) ? read_plate(prepared.job)
                                         : core::read_part(prepared.job.source, prepared.job.shaping);
  if (note) {
    for (const std::string& warning : prepared.part->warnings()) note(warning);
  }
  prepared.planner = std::make_shared<const core::IslandPlanner>(prepared.part->zones());
  choose_layers(prepared, layers);
  prepared.offset = offset_on_bed(prepared.job.place, prepared.part->extent(), prepared.job.profile.printer);
  const double height =
      layers ? underside(prepared.job.source, prepared.first + prepared.count) - prepared.lowered
             : prepared.part->height();
  check_fit(prepared, height);
  place_gradients(prepared);
  prepared.frame = frame_of(prepared);
  return prepared;
}

gcode::PrintSettings print_settings(const PreparedJob& prepared) {
  return {prepared.job.print, prepared.frame};
}

namespace {

/// Volume of a layer ÷ its printing time, mm³/s; volume that a thin line leaves out takes no time.
double layer_flow(const Job& job) {
  const double laid = job.line_width.value_or(job.bead_width);
  double flow = job.print.automatic_flow ? job.profile.printer.max_flow : job.print.flow;
  if (job.print.speed) flow = *job.print.speed * laid * job.source.layer_height;
  return flow * job.bead_width / laid;
}

}  // namespace

LookaheadOptions lookahead_options(const PreparedJob& prepared) {
  LookaheadOptions options;
  options.plan.bead_width = prepared.job.bead_width;
  options.plan.perimeters = prepared.job.perimeters;
  options.plan.seed_distance = prepared.job.seed_distance;
  options.plan.min_bead_width = prepared.job.profile.printer.bead_width_range[0];
  options.flow = layer_flow(prepared.job);
  options.plan.max_bead_width = prepared.job.profile.printer.bead_width_range[1];
  options.planner = prepared.planner;
  options.threads = prepared.threads;
  options.patient = prepared.job.full_quality;
  options.first = prepared.first;
  options.count = prepared.count;
  return options;
}

gcode::PlacedLayer placed(const PreparedJob& prepared, const PlannedLayer& planned) {
  gcode::PlacedLayer layer;
  layer.index = planned.layer.index - prepared.first;
  layer.top = planned.layer.top - prepared.lowered;
  layer.height = planned.layer.height;
  for (const core::Island& island : planned.layer.islands) {
    layer.outlines.push_back(moved(island.outline, prepared.offset));
  }
  for (const core::IslandPlan& plan : planned.plans) {
    for (const core::PlannedCurve& curve : plan.curves) {
      layer.paths.push_back(on_bed(curve.path, prepared.offset));
      if (prepared.job.line_width) thin(layer.paths.back(), *prepared.job.line_width);
    }
  }
  return layer;
}

namespace {

/// A part whose lowest layers hold nothing that can be printed would begin in the air.
[[noreturn]] void refuse_beginning(const PreparedJob& prepared, const core::Layer& lowest,
                                   const core::Layer& first) {
  const std::size_t empty = first.index - lowest.index;
  throw core::DataError(
      prepared.job.file.string(), "part",
      fmt::format("{} nothing that can be printed; printing would begin in the air at z = {:.2f} mm",
                  empty == 1 ? "the first layer holds" : fmt::format("the first {} layers hold", empty),
                  first.top - first.height - prepared.lowered),
      prepared.job.one_by_one && is_plate(prepared.job)
          ? "turn the part, or choose a smaller bead_width"
          : fmt::format("begin higher with --layers {}:, or choose a smaller bead_width", first.index));
}

}  // namespace

void check_beginning(const PreparedJob& prepared) {
  const std::size_t end = prepared.first + prepared.count;
  std::optional<core::Layer> lowest;  // of a part of which no layer with a curve has been seen
  bool any = false;
  for (std::size_t index = prepared.first; index < end; ++index) {
    // Of parts that are printed layer by layer, only the first layers matter.
    if (any && !(prepared.job.one_by_one && is_plate(prepared.job))) return;
    core::Layer layer = prepared.part->layer(index);
    if (index == prepared.first || core::rests_on_bed(layer)) lowest = layer;
    if (!lowest || !has_curve(prepared, layer)) continue;
    if (layer.index != lowest->index) refuse_beginning(prepared, *lowest, layer);
    any = true;
    lowest.reset();
  }
  if (any) return;
  throw core::DataError(
      prepared.job.file.string(), "part", "is nowhere wide enough for a closed curve",
      fmt::format("choose a bead_width below {:g} mm, or scale the part", prepared.job.bead_width));
}

}  // namespace unicursal::host
