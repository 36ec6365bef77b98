#include "core/model/amf_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/model/zip_archive.hpp"
#include "core/text/malformed.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr int deepest_constellations = 32;
constexpr double farthest_vertex = 1e5;  ///< mm
constexpr std::size_t most_tints = 10'000;

double millimetres(std::string_view unit) {
  if (unit == "inch") return 25.4;
  if (unit == "feet" || unit == "foot") return 304.8;
  if (unit == "meter") return 1000;
  if (unit == "micron" || unit == "micrometer") return 1e-3;
  if (unit.empty() || unit == "millimeter") return 1;
  throw Malformed(in_quotes(unit) + " is not a unit of AMF");
}

std::string_view value(const pugi::xml_node& node, std::string_view name) {
  return child(node, name).child_value();
}

double number_or(const pugi::xml_node& node, std::string_view name, double otherwise) {
  const std::string_view text = value(node, name);
  return text.empty() ? otherwise : xml_number(text);
}

/// The colour of a node that may hold one; formulas and nothing give "".
std::string colour_of(const pugi::xml_node& node) {
  const pugi::xml_node colour = child(node, "color");
  if (!colour) return "";
  std::string result = "#";
  for (const char* const channel : {"r", "g", "b"}) {
    try {
      result +=
          fmt::format("{:02x}", int(std::lround(255 * std::clamp(number_or(colour, channel, 0), 0.0, 1.0))));
    } catch (const Malformed&) {
      return "";  // a formula
    }
  }
  return result;
}

/// The text of a child <metadata type="…">.
std::string metadata(const pugi::xml_node& node, std::string_view type) {
  for (const pugi::xml_node& entry : node.children("metadata")) {
    if (type == entry.attribute("type").value()) return name_in(entry.child_value());
  }
  return "";
}

class Reader {
 public:
  Reader(const pugi::xml_node& root, const std::string& file, Warnings& warnings)
      : root_(root),
        file_(file),
        warnings_(warnings),
        unit_(millimetres(root.attribute("unit").value())),
        angle_(metadata(root, "cad").find("Slic") == std::string::npos ? std::numbers::pi / 180 : 1) {
    for (const pugi::xml_node& node : root.children("material")) {
      Tint tint{colour_of(node), {}};
      for (std::string name : {metadata(node, "name"), std::string(node.attribute("id").value())}) {
        if (!name.empty()) tint.names.push_back(std::move(name));
      }
      materials_.emplace(node.attribute("id").value(), std::move(tint));
    }
    for (const char* const kind : {"object", "constellation"}) {
      for (const pugi::xml_node& node : root.children(kind))
        by_id_.emplace(node.attribute("id").value(), node);
    }
  }

  MeshModel read() {
    // What a constellation uses stands where it says; everything else where it is.
    std::map<std::string_view, bool> used;
    for (const pugi::xml_node& node : root_.children("constellation")) {
      for (const pugi::xml_node& instance : node.children("instance"))
        used[instance.attribute("objectid").value()] = true;
    }
    for (const pugi::xml_node& node : root_.children()) {
      const std::string_view kind = node.name();
      if (kind != "object" && kind != "constellation") continue;
      if (!used[node.attribute("id").value()]) place(node, Eigen::Affine3d::Identity(), 0);
    }
    return std::move(model_);
  }

 private:
  void place(const pugi::xml_node& node, const Eigen::Affine3d& transform, int depth) {
    if (depth > deepest_constellations || ++placed_ > most_bodies)
      throw Malformed("constellations are nested or repeated without end");
    if (std::string_view(node.name()) == "object") return add_object(node, transform);
    for (const pugi::xml_node& instance : node.children("instance")) {
      const auto found = by_id_.find(instance.attribute("objectid").value());
      if (found == by_id_.end()) throw Malformed("a constellation uses an object that is absent");
      if (value(instance, "printable") == "0") continue;
      const auto angle = [&](const char* name) { return number_or(instance, name, 0) * angle_; };
      const Vec3 shift(number_or(instance, "deltax", 0), number_or(instance, "deltay", 0),
                       number_or(instance, "deltaz", 0));
      const Eigen::Affine3d own =
          Eigen::Translation3d(unit_ * shift) * Eigen::AngleAxisd(angle("rz"), Vec3::UnitZ()) *
          Eigen::AngleAxisd(angle("ry"), Vec3::UnitY()) * Eigen::AngleAxisd(angle("rx"), Vec3::UnitX()) *
          Eigen::Scaling(stretch(instance));
      place(found->second, transform * own, depth + 1);
    }
  }

  /// What programs for slicing add to the standard: a scale, and a mirror as −1.
  static Vec3 stretch(const pugi::xml_node& instance) {
    const double all = number_or(instance, "scale", 1);
    return {all * number_or(instance, "scalex", 1) * number_or(instance, "mirrorx", 1),
            all * number_or(instance, "scaley", 1) * number_or(instance, "mirrory", 1),
            all * number_or(instance, "scalez", 1) * number_or(instance, "mirrorz", 1)};
  }

  void add_object(const pugi::xml_node& object, const Eigen::Affine3d& transform) {
    ++objects_;
    const std::string object_name = metadata(object, "name"), object_colour = colour_of(object);
    for (const pugi::xml_node& mesh : object.children("mesh")) {
      std::vector<Vec3> vertices;
      for (const pugi::xml_node& vertex : child(mesh, "vertices").children("vertex")) {
        const pugi::xml_node at = child(vertex, "coordinates");
        const Vec3 p(xml_number(value(at, "x")), xml_number(value(at, "y")), xml_number(value(at, "z")));
        if (++vertices_ > most_triangles)
          throw Malformed("it has more than ten million vertices, copies included");
        vertices.push_back(transform * (unit_ * p));
        if (!vertices.back().allFinite() || vertices.back().cwiseAbs().maxCoeff() > farthest_vertex)
          throw Malformed(fmt::format("vertex {} lies more than 100 m away", vertices.size()));
      }
      for (const pugi::xml_node& volume : mesh.children("volume"))
        add_volume(volume, vertices, object_name, object_colour, transform.linear().determinant() < 0);
    }
  }

  void add_volume(const pugi::xml_node& volume, const std::vector<Vec3>& vertices,
                  const std::string& object_name, const std::string& object_colour, bool mirrored) {
    const std::string kind = metadata(volume, "slic3r.volume_type");
    if (std::string_view(volume.attribute("type").value()) == "support" || kind.starts_with("Support"))
      return warnings_.add(file_ + ": supports are not printed");
    MeshBody body;
    body.object = objects_;
    for (std::string name : {metadata(volume, "name"), object_name}) {
      if (!name.empty()) body.names.push_back(std::move(name));
    }
    if (metadata(volume, "slic3r.modifier") == "1" || kind == "ParameterModifier")
      body.role = BodyRole::modifier;
    if (kind == "NegativeVolume") body.role = BodyRole::negative;
    const auto material = materials_.find(volume.attribute("materialid").value());
    if (material != materials_.end()) body.tint = material->second;
    if (const std::string own = colour_of(volume); !own.empty()) body.tint.colour = own;
    if (body.tint.colour.empty()) body.tint.colour = object_colour;
    std::vector<Tint> palette{body.tint};
    std::vector<std::uint32_t> tints;
    for (const pugi::xml_node& node : volume.children("triangle")) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        static constexpr std::array names{"v1", "v2", "v3"};
        const std::size_t i = xml_index(value(node, names[k]));
        if (i >= vertices.size())
          throw Malformed(fmt::format("a triangle names vertex {} of {}", i, vertices.size()));
        triangle[k] = vertices[i];
      }
      if (++triangles_ > most_triangles)
        throw Malformed("it has more than ten million triangles, copies included");
      if (mirrored) std::swap(triangle[1], triangle[2]);
      body.triangles.push_back(triangle);
      tints.push_back(tint_of(node, palette));
    }
    for (MeshBody& divided : divided_by_tint(std::move(body), tints, palette))
      model_.push_back(std::move(divided));
  }

  static std::uint32_t tint_of(const pugi::xml_node& triangle, std::vector<Tint>& palette) {
    const std::string colour = colour_of(triangle);
    if (colour.empty() || colour == palette.front().colour) return 0;
    auto found =
        std::find_if(palette.begin(), palette.end(), [&](const Tint& t) { return t.colour == colour; });
    if (palette.size() >= most_tints) throw Malformed("it has more than ten thousand colours");
    if (found == palette.end()) found = palette.insert(palette.end(), Tint{colour, {}});
    return std::uint32_t(found - palette.begin());
  }

  pugi::xml_node root_;
  const std::string& file_;
  Warnings& warnings_;
  double unit_;
  double angle_;  ///< rad; the standard's degrees, except in files of Slic3r and its successors
  std::map<std::string_view, Tint> materials_;
  std::map<std::string_view, pugi::xml_node> by_id_;
  MeshModel model_;
  std::size_t objects_ = 0, placed_ = 0, vertices_ = 0, triangles_ = 0;
};

/// The file in an archive that is an AMF; programs do not agree on its name.
std::string unzipped(const std::string& bytes, const std::string& file) {
  ZipArchive archive(bytes, file);
  const std::vector<std::string> names = archive.names();
  const auto is_amf = [](const std::string& name) { return lower(name).ends_with(".amf"); };
  auto found = std::find_if(names.begin(), names.end(), is_amf);
  if (found == names.end() && names.size() == 1) found = names.begin();
  if (found == names.end())
    throw ModelError(file, "", "the archive holds no AMF file", "save the model again");
  return archive.content(*found).value_or("");
}

}  // namespace

MeshModel read_amf(std::string bytes, const std::string& file, Warnings& warnings) {
  if (is_zip(bytes)) bytes = unzipped(bytes, file);
  pugi::xml_document document;
  parse_xml(document, bytes, file);
  const pugi::xml_node root = document.document_element();
  try {
    if (local_name(root) != "amf") throw Malformed("this is not an AMF model");
    MeshModel model = Reader(root, file, warnings).read();
    if (model.empty()) throw Malformed("it holds no mesh to be printed");
    return model;
  } catch (const Malformed& problem) {
    throw ModelError(file, "", problem.what(), "save the model again");
  }
}

}  // namespace unicursal::core
