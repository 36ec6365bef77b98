#include "core/model/obj_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/model/edge_pairing.hpp"
#include "core/model/weld.hpp"
#include "core/text/file_bytes.hpp"

namespace unicursal::core {
namespace {

constexpr double farthest_vertex = 1e5;        ///< mm
constexpr std::size_t most_vertex_tints = 64;  ///< more are a scan or a gradient, not materials
constexpr std::size_t most_materials = 10000;

/// Cuts a text into lines, and a line into words; a backslash joins lines.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  bool next() {
    words_.clear();
    if (at_ >= text_.size()) return false;
    bool joined = true;
    while (joined && at_ < text_.size()) {
      const std::size_t end = std::min(text_.size(), text_.find_first_of("\r\n", at_));
      std::string_view line = text_.substr(at_, end - at_);
      at_ = std::min(text_.size(), end + (text_.substr(end, 2) == "\r\n" ? 2 : 1));
      ++number_;
      joined = line.ends_with('\\');
      if (joined) line.remove_suffix(1);
      cut(line);
    }
    return true;
  }

  const std::vector<std::string_view>& words() const { return words_; }
  /// Everything behind the first word, as a name.
  std::string name() const {
    std::string result;
    for (std::size_t i = 1; i < words_.size(); ++i) result += (i > 1 ? " " : "") + std::string(words_[i]);
    return result;
  }
  std::size_t number() const { return number_; }

 private:
  void cut(std::string_view line) {
    line = line.substr(0, line.find('#'));
    while (true) {
      const auto first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos) return;
      line.remove_prefix(first);
      const auto end = std::min(line.size(), line.find_first_of(" \t"));
      words_.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
  }

  std::string_view text_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0, number_ = 0;
};

std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string colour(double r, double g, double b) {
  const auto byte = [](double x) { return int(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(r), byte(g), byte(b));
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::filesystem::path& file, Warnings& warnings)
      : text_(text), path_(file), file_(file.string()), warnings_(warnings), lines_(text) {}

  MeshModel read() {
    by_object_ = text_.starts_with("o ") || text_.find("\no ") != std::string_view::npos ||
                 text_.find("\ro ") != std::string_view::npos;
    read_materials();
    bodies_.emplace_back();
    while (lines_.next()) {
      if (!lines_.words().empty()) read_line();
    }
    std::erase_if(bodies_, [](const Body& body) { return body.triangles.empty(); });
    if (bodies_.empty())
      throw ModelError(file_, "", "it holds no faces", "export the model again, as a mesh");
    unite_open_bodies();
    MeshModel model;
    for (Body& body : bodies_) {
      MeshBody made;
      made.object = model.size();
      if (!body.name.empty()) made.names.push_back(body.name);
      made.triangles = std::move(body.triangles);
      for (MeshBody& divided : divided_by_tint(std::move(made), tints_of(body), palette_))
        model.push_back(std::move(divided));
    }
    return model;
  }

 private:
  struct Body {
    std::string name;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> tints;
  };

  [[noreturn]] void refuse(const std::string& problem) const {
    throw ModelError(file_, fmt::format("line {}", lines_.number()), problem, "export the model again");
  }

  void read_line() {
    const std::string_view kind = lines_.words().front();
    if (kind == "v") {
      read_vertex();
    } else if (kind == "f") {
      read_face();
    } else if (kind == "o" || (kind == "g" && !by_object_)) {
      bodies_.push_back({lines_.name(), {}, {}});
    } else if (kind == "usemtl") {
      const std::string name = lines_.name();
      const auto known = materials_.find(name);
      material_ = known != materials_.end() ? known->second : material(name, {"", {name}});
    }
  }

  std::uint32_t material(const std::string& name, Tint tint) {
    if (materials_.size() >= most_materials) refuse("it has too many materials");
    palette_.push_back(std::move(tint));
    return materials_[name] = std::uint32_t(palette_.size() - 1);
  }

  void read_vertex() {
    const auto& words = lines_.words();
    std::vector<double> values;
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto value = number(words[i]);
      if (!value) refuse(in_quotes(words[i]) + " is not a number");
      values.push_back(*value);
    }
    if (values.size() < 3) refuse("a vertex needs three numbers");
    vertices_.emplace_back(values[0], values[1], values[2]);
    if (vertices_.back().cwiseAbs().maxCoeff() > farthest_vertex)
      refuse("this vertex lies more than 100 m away");
    if (values.size() >= 6) {
      colours_.resize(vertices_.size() - 1);
      colours_.push_back(colour(values[3], values[4], values[5]));
    }
  }

  std::size_t vertex(std::string_view word) const {
    word = word.substr(0, word.find('/'));
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      refuse(in_quotes(word) + " is not a vertex");
    const auto count = static_cast<long long>(vertices_.size());
    if (value < 0) value += count + 1;
    if (value < 1 || value > count)
      refuse(fmt::format("{} is none of the {} vertices so far", in_quotes(word), count));
    return std::size_t(value - 1);
  }

  void read_face() {
    std::vector<std::size_t> corners;
    for (std::size_t i = 1; i < lines_.words().size(); ++i) corners.push_back(vertex(lines_.words()[i]));
    if (corners.size() < 3) refuse("a face needs three vertices");
    Body& body = bodies_.back();
    for (std::size_t i = 2; i < corners.size(); ++i) {
      if (++triangles_ > most_triangles) refuse("it has more than ten million triangles");
      body.triangles.push_back({vertices_[corners[0]], vertices_[corners[i - 1]], vertices_[corners[i]]});
      body.tints.push_back(material_ != 0 ? material_
                                          : vertex_tint({corners[0], corners[i - 1], corners[i]}));
    }
  }

  /// The tint that most corners have, or the first one.
  std::uint32_t vertex_tint(const std::array<std::size_t, 3>& corners) {
    if (colours_.empty()) return 0;
    const auto at = [&](std::size_t k) {
      return corners[k] < colours_.size() ? colours_[corners[k]] : std::string();
    };
    const std::string chosen = at(1) == at(2) ? at(1) : at(0);
    if (chosen.empty()) return 0;
    const auto known = by_colour_.find(chosen);
    if (known != by_colour_.end()) return known->second;
    palette_.push_back({chosen, {}});
    return by_colour_[chosen] = std::uint32_t(palette_.size() - 1);
  }

  std::vector<std::uint32_t> tints_of(const Body& body) {
    if (by_colour_.size() <= most_vertex_tints) return body.tints;
    warnings_.add(fmt::format("{}: its vertices have {} colours, too many for zones; they are not read",
                              file_, by_colour_.size()));
    std::vector<std::uint32_t> tints = body.tints;
    for (auto& tint : tints) {
      if (palette_[tint].names.empty()) tint = 0;
    }
    return tints;
  }

  void read_materials() {
    for (const auto& path : material_files(text_, path_)) {
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error)) {
        warnings_.add(fmt::format("{}: its materials are in {}, which does not exist", file_, path.string()));
        continue;
      }
      const std::string bytes = file_bytes(path);
      std::uint32_t current = 0;
      for (Lines lines(bytes); lines.next();) {
        const auto& words = lines.words();
        if (words.empty()) continue;
        if (words[0] == "newmtl") {
          current = material(lines.name(), {"", {lines.name()}});
        } else if (words[0] == "Kd" && words.size() >= 4 && current != 0) {
          const auto r = number(words[1]), g = number(words[2]), b = number(words[3]);
          if (r && g && b) palette_[current].colour = colour(*r, *g, *b);
        }
      }
    }
  }

  static bool closed(const std::vector<Triangle>& triangles) {
    ClosedMesh mesh = indexed(triangles);
    drop_collapsed(mesh);
    return pair_edges(mesh).empty();
  }

  void unite_open_bodies() {
    if (bodies_.size() < 2) return;
    if (std::all_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return closed(body.triangles); }))
      return;
    Body all;
    for (const Body& body : bodies_) {
      all.triangles.insert(all.triangles.end(), body.triangles.begin(), body.triangles.end());
      all.tints.insert(all.tints.end(), body.tints.begin(), body.tints.end());
    }
    if (closed(all.triangles)) bodies_ = {std::move(all)};
  }

  std::string_view text_;
  std::filesystem::path path_;
  std::string file_;
  Warnings& warnings_;
  Lines lines_;
  bool by_object_ = false;
  std::vector<Vec3> vertices_;
  std::vector<std::string> colours_;  ///< per vertex; shorter if the last ones have none
  std::vector<Tint> palette_{Tint{}};
  std::map<std::string, std::uint32_t> materials_, by_colour_;
  std::uint32_t material_ = 0;
  std::vector<Body> bodies_;
  std::size_t triangles_ = 0;
};

}  // namespace

MeshModel read_obj(std::string_view bytes, const std::filesystem::path& file, Warnings& warnings) {
  return ObjReader(bytes, file, warnings).read();
}

std::vector<std::filesystem::path> material_files(std::string_view bytes, const std::filesystem::path& file) {
  std::vector<std::filesystem::path> result;
  std::size_t at = 0;
  while ((at = bytes.find("mtllib", at)) != std::string_view::npos) {
    const bool begins_line = at == 0 || bytes[at - 1] == '\n' || bytes[at - 1] == '\r';
    Lines line(bytes.substr(at));
    at += 6;
    if (!begins_line || !line.next() || line.words().size() < 2) continue;
    std::string name = line.name();
    std::replace(name.begin(), name.end(), '\\', '/');
    const auto path = file.parent_path() / std::filesystem::path(name).filename();
    if (std::find(result.begin(), result.end(), path) == result.end()) result.push_back(path);
    if (result.size() >= 16) break;
  }
  return result;
}

}  // namespace unicursal::core
