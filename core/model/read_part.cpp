#include "core/model/read_part.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/model/drawing_part.hpp"
#include "core/model/mesh_part.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

bool has_ending(const std::filesystem::path& file, const std::string& ending) {
  return lower(file.extension().string()) == ending;
}

}  // namespace

std::unique_ptr<const Part> read_part(const PartSource& source) {
  const auto& files = source.files;
  if (files.empty()) throw ModelError("", "file", "the part names no file", "name one SVG or some STL files");
  if (source.zones.empty()) {
    throw ModelError(files.front().string(), "", "the part has no zone", "add a zone that selects it");
  }
  const auto all = [&](const char* ending) {
    return std::all_of(files.begin(), files.end(),
                       [&](const auto& file) { return has_ending(file, ending); });
  };
  if (all(".stl")) return read_mesh_part(source);
  if (all(".svg") && files.size() == 1) return read_drawing_part(source);
  throw ModelError(files.back().string(), "file", "a part is one .svg file or some .stl files",
                   "export the model in one of these formats");
}

}  // namespace unicursal::core
