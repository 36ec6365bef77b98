#include "core/model/mesh_part.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/model/file_kind.hpp"
#include "core/model/largest_face.hpp"
#include "core/model/layer_stack.hpp"
#include "core/model/mesh_bodies.hpp"
#include "core/model/noted_error.hpp"
#include "core/model/slicer.hpp"
#include "core/model/zoning.hpp"

namespace unicursal::core {
namespace {

struct Paint {
  Slicer slicer;
  std::size_t zone = 0;
};

struct Body {
  Slicer slicer;
  BodyRole role = BodyRole::solid;
  std::optional<std::size_t> zone;  ///< absent: of a negative body
  std::vector<Paint> paints;
};

/// The bodies of one object: what is negative is cut out of all of them.
using Object = std::vector<Body>;

Eigen::AlignedBox3d box_of(const ClosedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& facet : mesh.facets) {
    for (const auto v : facet) box.extend(mesh.vertices[v]);
  }
  return box;
}

void turn(std::vector<MendedBody>& bodies, const Pose& pose) {
  Eigen::Matrix3d rotation = pose.rotation;
  if (pose.on_largest_face) {
    std::vector<Vec3> corners;
    for (const MendedBody& body : bodies) {
      if (body.role == BodyRole::solid)
        corners.insert(corners.end(), body.mesh.vertices.begin(), body.mesh.vertices.end());
    }
    rotation *= largest_face_down(corners);
  }
  if (rotation == Eigen::Matrix3d::Identity()) return;
  for (MendedBody& body : bodies) {
    for (Vec3& vertex : body.mesh.vertices) vertex = rotation * vertex;
    for (ClosedMesh& shell : body.shells) {
      for (Vec3& vertex : shell.vertices) vertex = rotation * vertex;
    }
  }
}

/// Adds the sections of an object's bodies and of their paint; the later ones cover the earlier ones.
void add_sections(const Object& object, double z, std::vector<Painted>& sections) {
  Region negative, whole;
  for (const Body& body : object) {
    if (body.role == BodyRole::negative)
      negative = unite(negative, enclosed(body.slicer.contours(z), FillRule::non_zero));
  }
  const auto section = [&](const Body& body) {
    Region region = enclosed(body.slicer.contours(z), FillRule::non_zero);
    return negative.empty() ? region : subtract(region, negative);
  };
  const bool modified = std::any_of(object.begin(), object.end(),
                                    [](const Body& body) { return body.role == BodyRole::modifier; });
  for (const Body& body : object) {
    if (body.role != BodyRole::solid) continue;
    const Region region = section(body);
    if (region.empty()) continue;
    if (modified) whole = unite(whole, region);
    sections.push_back({region, body.zone, ""});
    for (const Paint& paint : body.paints) {
      Region painted = intersect(enclosed(paint.slicer.contours(z), FillRule::non_zero), region);
      if (!painted.empty()) sections.push_back({std::move(painted), paint.zone, ""});
    }
  }
  for (const Body& body : object) {
    if (body.role != BodyRole::modifier || !body.zone) continue;
    Region region = intersect(section(body), whole);
    if (!region.empty()) sections.push_back({std::move(region), body.zone, ""});
  }
}

class MeshPart final : public Part {
 public:
  MeshPart(std::vector<Object> objects, const Eigen::AlignedBox3d& box, LayerStack stack,
           std::vector<Zone> zones, std::vector<std::string> warnings)
      : objects_(std::move(objects)),
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
    for (const Object& object : objects_) add_sections(object, box_.min().z() + layer.z, sections);
    layer.islands = zoned(sections).islands;
    return layer;
  }
  Box extent() const override { return {box_.min().head<2>(), box_.max().head<2>()}; }
  double height() const override { return stack_.height(); }
  const std::vector<Zone>& zones() const override { return zones_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 private:
  std::vector<Object> objects_;
  Eigen::AlignedBox3d box_;
  LayerStack stack_;
  std::vector<Zone> zones_;
  std::vector<std::string> warnings_;
};

class Builder {
 public:
  Builder(const PartSource& source, const Shaping& shaping, Warnings& warnings)
      : source_(source), shaping_(shaping), warnings_(warnings), zones_(source.zones) {}

  void add_files() {
    std::vector<MendedBody> bodies;
    const BodyOptions options{shaping_.pose.scale, shaping_.paint_depth, selects_by_number(source_.zones)};
    for (const std::filesystem::path& file : source_.files) add_bodies(bodies, file, options, warnings_);
    turn(bodies, shaping_.pose);
    std::map<std::size_t, std::size_t> object_of;
    for (MendedBody& body : bodies) {
      const auto [known, added] = object_of.try_emplace(body.object, objects.size());
      if (added) objects.emplace_back();
      if (body.role == BodyRole::solid) box.extend(box_of(body.mesh));
      add(std::move(body), objects[known->second]);
    }
  }

  void finish(std::vector<bool>* matched) const {
    if (matched) {
      zones_.mark_matched(*matched);
    } else {
      zones_.refuse_unmatched();
    }
    if (unclaimed_) {
      throw ModelError(unclaimed_->file.string(), "",
                       by_file_ ? "no zone selects this file" : "no zone selects " + unclaimed_->label(),
                       by_file_
                           ? "add a zone with select = " + in_quotes(unclaimed_->file.filename().string()) +
                                 ", or leave the file out"
                           : "add a zone that selects it; choose among " + zones_.choices());
    }
  }

  std::vector<Object> objects;
  Eigen::AlignedBox3d box;

 private:
  void add(MendedBody body, Object& object) {
    Body made{Slicer(std::move(body.mesh)), body.role, std::nullopt, {}};
    if (body.role != BodyRole::negative) made.zone = zones_.zone_of(body.name);
    if (body.role == BodyRole::solid && !made.zone && !unclaimed_) {
      unclaimed_ = body.name;
      by_file_ = body.name.names.empty() && body.name.tint == Tint{};
    }
    for (std::size_t i = 0; i < body.shells.size(); ++i) {
      if (body.shells[i].facets.empty()) continue;
      const Selectable paint{body.name.file, "", {}, body.paints[i], true};
      if (const auto zone = zones_.zone_of(paint)) {
        made.paints.push_back({Slicer(std::move(body.shells[i])), *zone});
      } else {
        warnings_.add(fmt::format("{}: no zone selects {}; it is printed like its body",
                                  body.name.file.string(), paint.label()));
      }
    }
    object.push_back(std::move(made));
  }

  const PartSource& source_;
  const Shaping& shaping_;
  Warnings& warnings_;
  BodyZones zones_;
  std::optional<Selectable> unclaimed_;
  bool by_file_ = false;
};

/// STL and OBJ files do not say their unit. A part that is too small for any bead was probably drawn in
/// another one.
void warn_of_unit(const PartSource& source, const Pose& pose, const Eigen::Vector3d& size,
                  Warnings& warnings) {
  constexpr double smallest = 3, largest_in_metres = 1000;  // mm
  if (size.maxCoeff() >= smallest || !pose.unchanged()) return;
  if (!std::all_of(source.files.begin(), source.files.end(), is_unitless_file)) return;
  const auto suspect = [&](const char* unit, const char* key, double factor) {
    return fmt::format("units = \"{}\" if its file is in {}, which makes {:.4g} x {:.4g} x {:.4g} mm", key,
                       unit, factor * size.x(), factor * size.y(), factor * size.z());
  };
  std::string remedies = suspect("inches", "inch", 25.4);
  const bool metres = 1000 * size.maxCoeff() < largest_in_metres;
  if (25.4 * size.maxCoeff() < smallest) {
    remedies = suspect("metres", "m", 1000);
  } else if (metres) {
    remedies += ", or " + suspect("metres", "m", 1000);
  }
  warnings.add(fmt::format("the part is only {:.3g} x {:.3g} x {:.3g} mm; write {}", size.x(), size.y(),
                           size.z(), remedies));
}

std::unique_ptr<const Part> read_with_notes(const PartSource& source, const Shaping& shaping,
                                            std::vector<bool>* matched, Warnings& warnings) {
  layers_of_mesh(0, source.layer_height,
                 source.first_layer_height);  // refuses a bad layer height before the files are read
  Builder builder(source, shaping, warnings);
  builder.add_files();
  builder.finish(matched);
  warn_of_unit(source, shaping.pose, builder.box.sizes(), warnings);
  const LayerStack stack =
      layers_of_mesh(builder.box.sizes().z(), source.layer_height, source.first_layer_height);
  return std::make_unique<MeshPart>(std::move(builder.objects), builder.box, stack, source.zones,
                                    warnings.sentences());
}

}  // namespace

std::unique_ptr<const Part> read_mesh_part(const PartSource& source, const Shaping& shaping,
                                           std::vector<bool>* matched) {
  Warnings warnings;
  try {
    return read_with_notes(source, shaping, matched, warnings);
  } catch (const ModelError& refusal) {
    throw NotedError(refusal, warnings.sentences());
  }
}

}  // namespace unicursal::core
