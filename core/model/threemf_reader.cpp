#include "core/model/threemf_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/drawing/css_colour.hpp"
#include "core/error.hpp"
#include "core/model/paint_code.hpp"
#include "core/model/slicer_project.hpp"
#include "core/model/zip_archive.hpp"
#include "core/text/malformed.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

using Affine = Eigen::Affine3d;

constexpr int deepest_components = 32;   ///< of objects within objects
constexpr double farthest_vertex = 1e5;  ///< mm
constexpr std::size_t most_tints = 10'000;
constexpr std::size_t most_paint_digits = 50'000'000;
/// What objects can be made of instead of triangles, by the names of elements; and what to do about it.
struct OtherShape {
  std::string_view element, words, remedy;
};
constexpr const char* as_mesh = "turn it into a mesh in the program that made it";
constexpr std::array<OtherShape, 5> other_shapes{{
    {"beamlattice", "a lattice of beams", as_mesh},
    {"slicestack", "slices", "save the model with its mesh"},
    {"levelset", "a shape given by a function", as_mesh},
    {"displacementmesh", "a surface displaced by a texture", as_mesh},
    {"booleanshape", "objects to be united or cut", as_mesh},
}};
constexpr std::string_view encrypted = "%3McF";  ///< begins an encrypted part (secure content extension 1.0)

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

struct Component {
  std::string path;  ///< of the part of the package that holds the object
  std::size_t id = 0;
  Affine transform = Affine::Identity();
};

struct Paint {
  std::uint32_t triangle;
  std::string code;
};

struct Object {
  std::string name;
  bool is_model = true;
  std::size_t tint = none;  ///< index into Resources::palette
  std::vector<Triangle> triangles;
  std::vector<std::size_t> tints;  ///< per triangle; none: that of the object
  std::vector<Paint> paints;       ///< as slicers write them
  std::vector<Component> components;
};

double millimetres(std::string_view unit) {
  if (unit == "micron") return 1e-3;
  if (unit == "centimeter") return 10;
  if (unit == "inch") return 25.4;
  if (unit == "foot") return 304.8;
  if (unit == "meter") return 1000;
  if (unit.empty() || unit == "millimeter") return 1;
  throw Malformed(in_quotes(unit) + " is not a unit of 3MF");
}

/// Twelve numbers: three columns of the matrix and the shift, row by row of its transpose.
Affine transform_of(std::string_view text, double unit) {
  Affine result = Affine::Identity();
  if (text.empty()) return result;
  std::array<double, 12> numbers{};
  for (double& number : numbers) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) throw Malformed("its transform does not have twelve numbers");
    text.remove_prefix(first);
    const auto end = std::min(text.size(), text.find_first_of(" \t\r\n"));
    number = xml_number(text.substr(0, end));
    text.remove_prefix(end);
  }
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      result.matrix()(row, column) = numbers[std::size_t(3 * column + row)] * (column == 3 ? unit : 1);
    }
  }
  return result;
}

std::string absolute(std::string path) {
  return path.starts_with('/') ? path.substr(1) : path;
}

/// One part of the package, with objects and materials.
class Part {
 public:
  Part(const pugi::xml_document& document, std::string path, std::vector<Tint>& palette, Warnings& warnings,
       const std::string& file)
      : path_(std::move(path)), palette_(palette), warnings_(warnings), file_(file) {
    const pugi::xml_node model = document.document_element();
    if (local_name(model) != "model") throw Malformed("it holds no 3MF model");
    unit_ = millimetres(attribute(model, "unit").value());
    const pugi::xml_node resources = child(model, "resources");
    for (const pugi::xml_node& node : resources.children()) {
      read_materials(node);
      find_other_shape(node);
    }
    for (const pugi::xml_node& node : resources.children()) {
      if (local_name(node) == "object") read_object(node);
    }
    for (const pugi::xml_node& node : child(model, "build").children()) {
      if (local_name(node) == "item") read_item(node);
    }
  }

  struct Item {
    Component component;
    bool printable = true;
  };

  const Object* object(std::size_t id) const {
    const auto found = objects_.find(id);
    return found == objects_.end() ? nullptr : &found->second;
  }
  const std::map<std::size_t, Object>& objects() const { return objects_; }
  const std::vector<Item>& items() const { return items_; }
  /// Shapes that are not meshes, each once.
  const std::vector<const OtherShape*>& others() const { return others_; }

 private:
  void note(const std::string& text) { warnings_.add(file_ + ": " + text); }

  const OtherShape* find_other_shape(const pugi::xml_node& node) {
    const auto* const found =
        std::find_if(other_shapes.begin(), other_shapes.end(),
                     [&](const OtherShape& shape) { return shape.element == local_name(node); });
    if (found == other_shapes.end()) return nullptr;
    if (std::find(others_.begin(), others_.end(), found) == others_.end()) others_.push_back(found);
    return found;
  }

  void read_materials(const pugi::xml_node& node) {
    const std::string_view kind = local_name(node);
    if (kind == "color" || kind == "material")
      note("materials of the 3MF draft of 2013 are not read; save the model again in a newer program");
    const bool bases = kind == "basematerials", colours = kind == "colorgroup";
    if (kind == "texture2d" || kind == "texture2dgroup")
      note("textures are not read; colour the model by triangles");
    if (kind == "compositematerials" || kind == "multiproperties")
      note("mixed materials are not read; colour the model by triangles");
    if (!bases && !colours) return;
    std::vector<std::size_t>& group = groups_[xml_index(attribute(node, "id").value())];
    for (const pugi::xml_node& entry : node.children()) {
      std::string text = attribute(entry, bases ? "displaycolor" : "color").value();
      if (text.size() == 9) text.resize(7);  // without its opacity: plastic is what it is
      Tint tint{css_colour(text).value_or(""), {}};
      if (std::string name = name_in(attribute(entry, "name").value()); !name.empty())
        tint.names.push_back(std::move(name));
      if (palette_.size() >= most_tints) throw Malformed("it has more than ten thousand colours");
      group.push_back(palette_.size());
      palette_.push_back(std::move(tint));
    }
  }

  std::size_t tint(const pugi::xml_attribute& group, const pugi::xml_attribute& index) const {
    if (!group) return none;
    const auto found = groups_.find(xml_index(group.value()));
    const std::size_t i = index ? xml_index(index.value()) : 0;
    return found == groups_.end() || i >= found->second.size() ? none : found->second[i];
  }

  void read_object(const pugi::xml_node& node) {
    const std::string_view type = attribute(node, "type").value();
    Object& object = objects_[xml_index(attribute(node, "id").value())];
    object.name = name_in(attribute(node, "name").value());
    object.is_model = type.empty() || type == "model" || type == "surface";
    object.tint = tint(attribute(node, "pid"), attribute(node, "pindex"));
    if (const pugi::xml_node mesh = child(node, "mesh")) read_mesh(mesh, attribute(node, "pid"), object);
    for (const pugi::xml_node& inner : node.children()) {
      if (const OtherShape* const other = find_other_shape(inner))
        note(fmt::format("{}: this is not read; {}", other->words, other->remedy));
    }
    if (std::string_view(attribute(node, "meshresolution").value()) == "lowres")
      note("slices are not read; the coarse mesh beside them is printed");
    for (const pugi::xml_node& inner : child(node, "components").children()) {
      if (local_name(inner) == "component") object.components.push_back(component(inner));
    }
  }

  Component component(const pugi::xml_node& node) const {
    const std::string path = attribute(node, "path").value();
    return {path.empty() ? path_ : absolute(path), xml_index(attribute(node, "objectid").value()),
            transform_of(attribute(node, "transform").value(), unit_)};
  }

  void read_mesh(const pugi::xml_node& mesh, const pugi::xml_attribute& default_group, Object& object) {
    std::vector<Vec3> vertices;
    for (const pugi::xml_node& node : child(mesh, "vertices").children()) {
      if (local_name(node) != "vertex") continue;
      vertices.emplace_back(xml_number(node.attribute("x").value()), xml_number(node.attribute("y").value()),
                            xml_number(node.attribute("z").value()));
      vertices.back() *= unit_;
    }
    if (const pugi::xml_node lattice = child(mesh, "beamlattice")) {
      find_other_shape(lattice);
      note("beams of a lattice are not read; turn them into a mesh");
    }
    for (const pugi::xml_node& node : child(mesh, "triangles").children()) {
      if (local_name(node) == "triangle") read_triangle(node, vertices, default_group, object);
    }
  }

  void read_triangle(const pugi::xml_node& node, const std::vector<Vec3>& vertices,
                     const pugi::xml_attribute& default_group, Object& object) {
    Triangle triangle;
    unsigned corners = 0;  // a bit for each
    pugi::xml_attribute group = default_group, first;
    bool tinted = false, varies = false;
    std::string_view first_corner, code;
    for (const pugi::xml_attribute& a : node.attributes()) {
      const std::string_view name = local_name(a.name());
      if (name == "v1" || name == "v2" || name == "v3") {
        const std::size_t i = xml_index(a.value());
        if (i >= vertices.size())
          throw Malformed(fmt::format("a triangle names vertex {} of {}", i, vertices.size()));
        triangle[std::size_t(name[1] - '1')] = vertices[i];
        corners |= 1U << unsigned(name[1] - '1');
      } else if (name == "pid") {
        group = a;
      } else if (name == "p1") {
        first = a, tinted = true, first_corner = a.value();
      } else if ((name == "p2" || name == "p3") && tinted && first_corner != a.value()) {
        varies = true;
      } else if (name == "mmu_segmentation" || name == "paint_color") {
        code = a.value();
      }
    }
    if (corners != 7) throw Malformed("a triangle does not name its three corners");
    if (object.triangles.size() >= most_triangles) throw Malformed("it has more than ten million triangles");
    if (!code.empty()) object.paints.push_back({std::uint32_t(object.triangles.size()), std::string(code)});
    object.triangles.push_back(triangle);
    object.tints.push_back(tinted ? tint(group, first) : none);
    if (varies && object.tints.back() != none)
      note("colours that change within a triangle are read as that of its first corner");
  }

  void read_item(const pugi::xml_node& node) {
    items_.push_back({component(node), std::string_view(attribute(node, "printable").value()) != "0"});
  }

  std::string path_;
  std::vector<Tint>& palette_;
  Warnings& warnings_;
  const std::string& file_;
  double unit_ = 1;
  std::map<std::size_t, std::vector<std::size_t>> groups_;  ///< by id: indices into the palette
  std::map<std::size_t, Object> objects_;
  std::vector<Item> items_;
  std::vector<const OtherShape*> others_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file, Warnings& warnings)
      : file_(file), warnings_(warnings), archive_(bytes, file), project_(slicer_project(archive_, file)) {}

  MeshModel read() {
    const std::string root = root_path();
    const Part& main = part(root);
    choose_plate();
    std::map<std::size_t, std::size_t> instances;  // of each object
    for (const Part::Item& item : main.items()) {
      const std::size_t instance = instances[item.component.id]++;
      if (!item.printable || !on_plate(item.component.id, instance)) continue;
      place_object(item.component);
    }
    // Some programs leave the build empty.
    if (main.items().empty()) {
      for (const auto& [id, object] : main.objects()) place_object({root, id, Affine::Identity()});
    }
    if (std::none_of(model_.begin(), model_.end(),
                     [](const MeshBody& b) { return b.role == BodyRole::solid; }))
      refuse_without_mesh();
    return std::move(model_);
  }

 private:
  [[noreturn]] void refuse_without_mesh() const {
    const std::vector<std::string> names = archive_.names();
    if (std::any_of(names.begin(), names.end(), [](const auto& name) { return name.ends_with(".gcode"); })) {
      throw ModelError(file_, "", "it holds G-code that a slicer made for a printer, and no mesh",
                       "save the project itself, not the sliced plate");
    }
    for (const auto& [path, part] : parts_) {
      if (part->others().empty()) continue;
      const OtherShape& other = *part->others().front();
      throw ModelError(file_, "", fmt::format("it holds {}, and no mesh to be printed", other.words),
                       std::string(other.remedy));
    }
    throw ModelError(file_, "", "it holds no mesh to be printed",
                     "save the model again, with its objects on the bed");
  }

  /// Where the package says that its model is.
  std::string root_path() {
    if (std::optional<std::string> bytes = archive_.content("_rels/.rels")) {
      pugi::xml_document document;
      parse_xml(document, *bytes, file_ + ": _rels/.rels");
      for (const pugi::xml_node& node : document.document_element().children()) {
        if (std::string_view(node.attribute("Type").value()).ends_with("/3dmodel"))
          return absolute(node.attribute("Target").value());
      }
    }
    return "3D/3dmodel.model";
  }

  const Part& part(const std::string& path) {
    auto& known = parts_[path];
    if (known) return *known;
    std::optional<std::string> bytes = archive_.content(path);
    if (!bytes)
      throw ModelError(file_, in_quotes(path), "this part of the package is absent", "save the model again");
    if (bytes->starts_with(encrypted)) {
      throw ModelError(file_, in_quotes(path), "this part of the package is encrypted",
                       "save the model without encryption");
    }
    pugi::xml_document document;
    parse_xml(document, *bytes, file_ + ": " + path);
    try {
      known = std::make_unique<Part>(document, path, palette_, warnings_, file_);
    } catch (const Malformed& problem) {
      throw ModelError(file_, in_quotes(path), problem.what(), "save the model again");
    }
    return *known;
  }

  void choose_plate() {
    if (!project_) return;
    const auto& plates = project_->plates;
    const auto first =
        std::find_if(plates.begin(), plates.end(), [](const auto& plate) { return !plate.empty(); });
    if (first == plates.end()) return;
    const auto used =
        std::count_if(plates.begin(), plates.end(), [](const auto& plate) { return !plate.empty(); });
    if (used < 2) return;
    plate_ = &*first;
    warnings_.add(
        fmt::format("{}: it has {} plates; plate {} is read", file_, used, first - plates.begin() + 1));
  }

  bool on_plate(std::size_t id, std::size_t instance) const {
    return !plate_ || plate_->contains({id, instance});
  }

  const ProjectObject* project_object(std::size_t id) const {
    if (!project_) return nullptr;
    const auto found = project_->objects.find(id);
    return found == project_->objects.end() ? nullptr : &found->second;
  }

  void place_object(const Component& component) {
    ++objects_;
    std::vector<std::string> names;
    const ProjectObject* const project = project_object(component.id);
    if (project && !project->name.empty()) names.push_back(project->name);
    place(component, component.transform, names, project, 0, 0);
  }

  /// `inherited`: the tint of the objects around, as an index into the palette plus 1; 0 if they have none.
  void place(const Component& component, const Affine& transform, std::vector<std::string> names,
             const ProjectObject* project, std::size_t inherited, int depth) {
    const Object* const object = part(component.path).object(component.id);
    if (!object) {
      throw ModelError(file_, fmt::format("object {}", component.id), "it is used but absent",
                       "save the model again");
    }
    if (depth > deepest_components || ++placed_ > most_bodies) {
      throw ModelError(file_, fmt::format("object {}", component.id),
                       "objects are nested or repeated without end", "save the model again");
    }
    if (!object->is_model) return warnings_.add(file_ + ": supports are not printed");
    if (!object->name.empty() && std::find(names.begin(), names.end(), object->name) == names.end())
      names.insert(names.begin(), object->name);
    if (object->tint != none) inherited = object->tint + 1;
    if (!object->triangles.empty()) add_meshes(component.id, *object, transform, names, project, inherited);
    for (const Component& inner : object->components)
      place(inner, transform * inner.transform, names, project, inherited, depth + 1);
  }

  void add_meshes(std::size_t id, const Object& object, const Affine& transform,
                  const std::vector<std::string>& names, const ProjectObject* project,
                  std::size_t inherited) {
    if (project && !project->volumes.empty()) {
      for (const ProjectVolume& volume : project->volumes) {
        const std::size_t end = std::min(volume.last, object.triangles.size() - 1) + 1;
        if (volume.first < end)
          add_mesh(object, volume.first, end, transform, names, project, &volume.part, inherited);
      }
      return;
    }
    const ProjectPart* project_part = nullptr;
    if (project) {
      if (const auto found = project->parts.find(id); found != project->parts.end())
        project_part = &found->second;
    }
    add_mesh(object, 0, object.triangles.size(), transform, names, project, project_part, inherited);
  }

  void add_mesh(const Object& object, std::size_t begin, std::size_t end, const Affine& transform,
                std::vector<std::string> names, const ProjectObject* project, const ProjectPart* project_part,
                std::size_t inherited) {
    if (project_part && !project_part->printed) return;
    triangles_ += end - begin;
    if (triangles_ > most_triangles) {
      throw ModelError(file_, "", "it has more than ten million triangles, copies included",
                       "simplify the model");
    }
    MeshBody body;
    body.object = objects_;
    body.names = std::move(names);
    if (project_part) {
      body.role = project_part->role;
      std::erase(body.names, project_part->name);
      if (!project_part->name.empty()) body.names.insert(body.names.begin(), project_part->name);
    }
    const bool mirrored = transform.linear().determinant() < 0;
    for (std::size_t t = begin; t < end; ++t) {
      Triangle triangle = object.triangles[t];
      for (Vec3& corner : triangle) {
        corner = transform * corner;
        if (!corner.allFinite() || corner.cwiseAbs().maxCoeff() > farthest_vertex) {
          throw ModelError(file_, fmt::format("triangle {}", t + 1), "it lies more than 100 m away",
                           "save the model again");
        }
      }
      if (mirrored) std::swap(triangle[1], triangle[2]);
      body.triangles.push_back(triangle);
    }
    if (project) {
      const std::size_t own =
          project_part && project_part->filament > 0 ? project_part->filament : project->filament;
      body.tint = project_->tint(own);
      if (body.role == BodyRole::modifier && project_part && project_part->filament == 0) return;
    } else if (project_) {
      body.tint = project_->tint(1);
    }
    add_painted(object, begin, end, mirrored, inherited, std::move(body));
  }

  void add_painted(const Object& object, std::size_t begin, std::size_t end, bool mirrored,
                   std::size_t inherited, MeshBody body) {
    const bool tinted = inherited > 0 || std::any_of(object.tints.begin() + std::ptrdiff_t(begin),
                                                     object.tints.begin() + std::ptrdiff_t(end),
                                                     [](std::size_t tint) { return tint != none; });
    // The filaments of a slicer's project count for more than colours, which it does not print.
    if (tinted && body.tint.names.empty()) {
      std::vector<std::uint32_t> tints;
      for (std::size_t t = begin; t < end; ++t) {
        std::size_t tint = object.tints[t];
        if (tint == none) tint = inherited > 0 ? inherited - 1 : palette_.size();
        tints.push_back(std::uint32_t(tint));
      }
      for (MeshBody& divided : divided_by_tint(std::move(body), tints, palette_))
        model_.push_back(std::move(divided));
      return;
    }
    std::map<std::size_t, std::uint32_t> paint_of;  // by filament
    auto next =
        std::lower_bound(object.paints.begin(), object.paints.end(), begin,
                         [](const Paint& paint, std::size_t first) { return paint.triangle < first; });
    for (; next != object.paints.end() && next->triangle < end; ++next) {
      const Paint& paint = *next;
      for (const PaintedLeaf& leaf : leaves(paint)) {
        const Tint tint = project_ ? project_->tint(leaf.filament) : SlicerProject{}.tint(leaf.filament);
        if (tint == body.tint) continue;
        const auto [found, added] = paint_of.try_emplace(leaf.filament, std::uint32_t(body.paints.size()));
        if (added) body.paints.push_back(tint);
        Triangle corners = leaf.corners;
        if (mirrored) {
          for (Vec3& corner : corners) std::swap(corner[1], corner[2]);
          std::swap(corners[1], corners[2]);
        }
        body.painted.push_back({std::uint32_t(paint.triangle - begin), found->second, corners});
      }
    }
    model_.push_back(std::move(body));
  }

  std::vector<PaintedLeaf> leaves(const Paint& paint) {
    try {
      // Each piece takes a digit at least, also one without paint. Objects are read once for each place.
      digits_ += paint.code.size();
      if (digits_ > most_paint_digits) throw Malformed("its paint has more than fifty million pieces");
      return painted_leaves(paint.code);
    } catch (const Malformed& problem) {
      throw ModelError(file_, fmt::format("triangle {}", paint.triangle + 1), problem.what(),
                       "save the project again, or remove the paint");
    }
  }

  const std::string& file_;
  Warnings& warnings_;
  ZipArchive archive_;
  std::optional<SlicerProject> project_;
  std::vector<Tint> palette_;
  std::map<std::string, std::unique_ptr<Part>> parts_;
  const std::set<std::pair<std::size_t, std::size_t>>* plate_ = nullptr;
  MeshModel model_;
  std::size_t objects_ = 0, placed_ = 0, triangles_ = 0, digits_ = 0;
};

}  // namespace

MeshModel read_3mf(std::string_view bytes, const std::string& file, Warnings& warnings) {
  return Reader(bytes, file, warnings).read();
}

}  // namespace unicursal::core
