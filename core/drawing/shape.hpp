// The last stage of reading a drawing: areas with their colours and names.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/region.hpp"

namespace unicursal::core {

/// The names of an element: its own (id, label, name), then those of the groups around it.
struct Names {
  std::vector<std::string> own;
  std::shared_ptr<const Names> outer;
};

struct Shape {
  Region region;                       ///< never empty; mm
  std::string fill;                    ///< as computed: "#rrggbb", or "url(#…)"
  std::shared_ptr<const Names> names;  ///< null: it has none
};

bool has_name(const Shape& shape, std::string_view name);
/// The nearest names come first.
std::vector<std::string> all_names(const Shape& shape);

}  // namespace unicursal::core
