#include "core/model/drawing_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "core/drawing/css_colour.hpp"
#include "core/drawing/svg_reader.hpp"
#include "core/error.hpp"
#include "core/model/layer_stack.hpp"
#include "core/model/noted_error.hpp"
#include "core/model/zoning.hpp"

namespace unicursal::core {
namespace {

class DrawingPart final : public Part {
 public:
  DrawingPart(std::vector<Island> islands, LayerStack stack, std::vector<Zone> zones,
              std::vector<std::string> warnings)
      : islands_(std::move(islands)),
        stack_(stack),
        zones_(std::move(zones)),
        warnings_(std::move(warnings)) {
    std::vector<Polygon> outlines;
    for (const Island& island : islands_) outlines.push_back(island.outline);
    extent_ = bounds(outlines);
  }

  std::size_t layer_count() const override { return stack_.count; }
  Layer layer(std::size_t index) const override {
    assert(index < stack_.count);
    Layer layer = stack_.layer(index);
    layer.islands = islands_;
    return layer;
  }
  Box extent() const override { return extent_; }
  double height() const override { return stack_.height(); }
  const std::vector<Zone>& zones() const override { return zones_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  std::vector<Island> islands_;
  LayerStack stack_;
  std::vector<Zone> zones_;
  std::vector<std::string> warnings_;
  Box extent_;
};

bool names_file(const std::string& select, const std::filesystem::path& file) {
  return select == file.filename() || select == file.stem();
}

bool selects(const Zone& zone, const Shape& shape, const std::filesystem::path& file) {
  if (zone.select.empty()) return false;
  const auto colour = css_colour(zone.select);
  return (colour && *colour == shape.fill) || zone.select == shape.fill || has_name(shape, zone.select) ||
         names_file(zone.select, file);
}

std::string label(const Shape& shape) {
  if (!shape.names) return shape.fill;
  return fmt::format("{} ({})", shape.fill, in_quotes(shape.names->own.front()));
}

/// The fills and names that a zone could select.
std::string choices(const std::vector<Shape>& shapes, const std::filesystem::path& file) {
  std::set<std::string> fills, names;
  for (const Shape& shape : shapes) {
    fills.insert(shape.fill);
    for (const std::string& name : all_names(shape)) names.insert(in_quotes(name));
  }
  std::vector<std::string> all(fills.begin(), fills.end());
  all.insert(all.end(), names.begin(), names.end());
  constexpr std::size_t most_listed = 12;
  std::string list = listed(all, most_listed);
  if (all.size() > most_listed) list += "; `unicursal inspect " + file.string() + "` lists the colours";
  return list;
}

std::string select_place(const Zone& zone) {
  return "select = " + in_quotes(zone.select);
}

void refuse_unmatched(const PartSource& source, const std::vector<Shape>& shapes) {
  const std::filesystem::path& file = source.files.front();
  for (const Zone& zone : source.zones) {
    if (std::none_of(shapes.begin(), shapes.end(), [&](const Shape& s) { return selects(zone, s, file); })) {
      throw ModelError(file.string(), select_place(zone), "this matches nothing in the drawing",
                       "choose among " + choices(shapes, file));
    }
  }
}

void mark_matched(const PartSource& source, const std::vector<Shape>& shapes, std::vector<bool>& matched) {
  for (std::size_t i = 0; i < source.zones.size(); ++i) {
    if (std::any_of(shapes.begin(), shapes.end(),
                    [&](const Shape& s) { return selects(source.zones[i], s, source.files.front()); }))
      matched.at(i) = true;
  }
}

std::optional<std::size_t> zone_of(const Shape& shape, const PartSource& source) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < source.zones.size(); ++i) {
    if (!selects(source.zones[i], shape, source.files.front())) continue;
    if (found) {
      throw ModelError(source.files.front().string(), select_place(source.zones[i]),
                       fmt::format("the shape {} is already selected by {}", label(shape),
                                   in_quotes(source.zones[*found].select)),
                       "let only one zone select it");
    }
    found = i;
  }
  return found;
}

/// mm; 0 without a shape.
double width_of(const std::vector<Shape>& shapes) {
  std::vector<Polygon> all;
  for (const Shape& shape : shapes) all.insert(all.end(), shape.region.begin(), shape.region.end());
  return all.empty() ? 0 : bounds(all).size().x();
}

/// Reads the drawing in its pose. A width is reached by reading it twice, so that curves are as smooth as in
/// a drawing of that size.
std::vector<Shape> read_posed(const PartSource& source, const Pose& pose, Warnings& warnings) {
  const std::filesystem::path& file = source.files.front();
  DrawingOptions options;
  options.strokes_are_contours = source.strokes_are_contours;
  options.turn = (pose.rotation * pose.scale.asDiagonal()).topLeftCorner<2, 2>();
  if (pose.width > 0) {
    Warnings ignored;
    const double width = width_of(read_svg(file, ignored, options).shapes);
    if (width > 0) options.turn *= pose.width / width;
  }
  return read_drawing(file, warnings, options).shapes;
}

void refuse_unclaimed(const std::filesystem::path& file, const std::vector<Unclaimed>& unclaimed) {
  if (unclaimed.empty()) return;
  const Unclaimed& worst = unclaimed.front();
  const std::string more =
      unclaimed.size() > 1 ? fmt::format(" (and {} more places)", unclaimed.size() - 1) : "";
  throw ModelError(file.string(), fmt::format("near ({:.4g}, {:.4g}) mm", worst.place.x(), worst.place.y()),
                   fmt::format("{:.3g} mm² of {} belong to no zone{}", worst.area, worst.label, more),
                   "add a zone that selects it, or delete it from the drawing");
}

void warn_of_covered(const std::vector<Zone>& zones, const std::vector<Island>& islands, Warnings& warnings) {
  std::set<std::size_t> seen;
  for (const Island& island : islands) {
    for (const ZoneRegion& region : island.zones) seen.insert(region.zone);
  }
  for (std::size_t i = 0; i < zones.size(); ++i) {
    if (!seen.contains(i)) {
      warnings.add("the zone " + in_quotes(zones[i].select) + " is empty: later shapes cover it");
    }
  }
}

std::unique_ptr<const Part> read_with_notes(const PartSource& source, const Pose& pose,
                                            std::vector<bool>* matched, Warnings& warnings) {
  const std::filesystem::path& file = source.files.front();
  const LayerStack stack =
      layers_of_drawing(source.height, source.layer_height, source.first_layer_height, warnings);
  const std::vector<Shape> shapes = read_posed(source, pose, warnings);
  if (matched) {
    mark_matched(source, shapes, *matched);
  } else {
    refuse_unmatched(source, shapes);
  }
  std::vector<Painted> painted;
  for (const Shape& shape : shapes) painted.push_back({shape.region, zone_of(shape, source), label(shape)});
  Zoning zoning = zoned(painted);
  refuse_unclaimed(file, zoning.unclaimed);
  if (zoning.islands.empty()) {
    throw ModelError(file.string(), "", "the drawing's shapes are too small to print",
                     "check its width and height");
  }
  if (!matched) warn_of_covered(source.zones, zoning.islands, warnings);
  return std::make_unique<DrawingPart>(std::move(zoning.islands), stack, source.zones, warnings.sentences());
}

}  // namespace

Drawing read_drawing(const std::filesystem::path& file, Warnings& warnings, const DrawingOptions& options) {
  Drawing drawing = read_svg(file, warnings, options);
  if (!drawing.shapes.empty()) return drawing;
  if (drawing.lines > 0 && !options.strokes_are_contours) {
    throw ModelError(file.string(), "", "the drawing holds only lines thinner than 0.15 mm",
                     "write outline = \"strokes\" in [part] if they are contours, or make them wider");
  }
  throw ModelError(file.string(), "", "the drawing holds no area",
                   "fill its shapes, or give them strokes that are wide enough to print");
}

std::unique_ptr<const Part> read_drawing_part(const PartSource& source, const Pose& pose,
                                              std::vector<bool>* matched) {
  Warnings warnings;
  try {
    return read_with_notes(source, pose, matched, warnings);
  } catch (const ModelError& refusal) {
    throw NotedError(refusal, warnings.sentences());
  }
}

}  // namespace unicursal::core
