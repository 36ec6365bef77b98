#include "core/drawing/shape.hpp"

#include <algorithm>

namespace unicursal::core {

bool has_name(const Shape& shape, std::string_view name) {
  for (const Names* names = shape.names.get(); names; names = names->outer.get()) {
    if (std::find(names->own.begin(), names->own.end(), name) != names->own.end()) return true;
  }
  return false;
}

std::vector<std::string> all_names(const Shape& shape) {
  std::vector<std::string> result;
  for (const Names* names = shape.names.get(); names; names = names->outer.get())
    result.insert(result.end(), names->own.begin(), names->own.end());
  return result;
}

}  // namespace unicursal::core
