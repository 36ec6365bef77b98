#include "core/model/file_kind.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

std::string ending(const std::filesystem::path& file) {
  return lower(file.extension().string());
}

}  // namespace

bool is_drawing_file(const std::filesystem::path& file) {
  return ending(file) == ".svg";
}

bool is_mesh_file(const std::filesystem::path& file) {
  static constexpr std::array endings{".stl", ".3mf", ".obj", ".amf"};
  return std::find(endings.begin(), endings.end(), ending(file)) != endings.end();
}

bool is_model_file(const std::filesystem::path& file) {
  return is_drawing_file(file) || is_mesh_file(file);
}

bool is_unitless_file(const std::filesystem::path& file) {
  return ending(file) == ".stl" || ending(file) == ".obj";
}

}  // namespace unicursal::core
