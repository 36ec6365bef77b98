#include "core/model/mesh_part.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/model/closed_mesh.hpp"
#include "core/model/layer_stack.hpp"
#include "core/model/slicer.hpp"
#include "core/model/stl_reader.hpp"
#include "core/model/zoning.hpp"

namespace unicursal::core {
namespace {

struct Body {
  Slicer slicer;
  std::size_t zone = 0;
};

Eigen::AlignedBox3d box_of(const ClosedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& facet : mesh.facets) {
    for (const auto v : facet) box.extend(mesh.vertices[v]);
  }
  return box;
}

class MeshPart final : public Part {
 public:
  MeshPart(std::vector<Body> bodies, const Eigen::AlignedBox3d& box, LayerStack stack,
           std::vector<Zone> zones, std::vector<std::string> warnings)
      : bodies_(std::move(bodies)),
        box_(box),
        stack_(stack),
        zones_(std::move(zones)),
        warnings_(std::move(warnings)) {}

  std::size_t layer_count() const override { return stack_.count; }
  Layer layer(std::size_t index) const override {
    assert(index < stack_.count);
    Layer layer = stack_.layer(index);
    // A part thinner than half of its only layer is cut in its own middle.
    if (layer.z >= box_.sizes().z()) layer.z = box_.sizes().z() / 2;
    std::vector<Painted> sections;
    for (const Body& body : bodies_) {
      Region section = enclosed(body.slicer.contours(box_.min().z() + layer.z), FillRule::non_zero);
      if (!section.empty()) sections.push_back({std::move(section), body.zone, ""});
    }
    layer.islands = zoned(sections).islands;
    return layer;
  }
  Box extent() const override { return {box_.min().head<2>(), box_.max().head<2>()}; }
  double height() const override { return stack_.height(); }
  const std::vector<Zone>& zones() const override { return zones_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  std::vector<Body> bodies_;
  Eigen::AlignedBox3d box_;
  LayerStack stack_;
  std::vector<Zone> zones_;
  std::vector<std::string> warnings_;
};

bool selects(const Zone& zone, const std::filesystem::path& file) {
  return !zone.select.empty() && (zone.select == file.filename() || zone.select == file.stem());
}

std::string choices(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(in_quotes(file.filename().string()));
  return listed(names);
}

std::size_t zone_of(const std::filesystem::path& file, const std::vector<Zone>& zones) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    if (!selects(zones[i], file)) continue;
    if (found) {
      throw ModelError(file.string(), "select = " + in_quotes(zones[i].select),
                       "this file is already selected by " + in_quotes(zones[*found].select),
                       "let only one zone select it");
    }
    found = i;
  }
  if (!found) {
    throw ModelError(
        file.string(), "", "no zone selects this file",
        "add a zone with select = " + in_quotes(file.filename().string()) + ", or leave the file out");
  }
  return *found;
}

void refuse_unmatched(const PartSource& source) {
  for (const Zone& zone : source.zones) {
    if (std::none_of(source.files.begin(), source.files.end(),
                     [&](const auto& f) { return selects(zone, f); })) {
      throw ModelError("", "select = " + in_quotes(zone.select), "this matches none of the files",
                       "choose among " + choices(source.files));
    }
  }
}

}  // namespace

std::unique_ptr<const Part> read_mesh_part(const PartSource& source) {
  Warnings warnings;
  layers_of_mesh(0, source.layer_height,
                 source.first_layer_height);  // refuses a bad layer height before the files are read
  refuse_unmatched(source);
  std::vector<Body> bodies;
  Eigen::AlignedBox3d box;
  for (const std::filesystem::path& file : source.files) {
    const std::size_t zone = zone_of(file, source.zones);
    ClosedMesh mesh = closed_mesh(read_stl(file, warnings), file.string(), warnings);
    box.extend(box_of(mesh));
    bodies.push_back({Slicer(std::move(mesh)), zone});
  }
  const LayerStack stack = layers_of_mesh(box.sizes().z(), source.layer_height, source.first_layer_height);
  return std::make_unique<MeshPart>(std::move(bodies), box, stack, source.zones, warnings.sentences());
}

}  // namespace unicursal::core
