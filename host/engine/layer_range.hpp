// Some of a part's layers.
#pragma once

#include <cstddef>

namespace unicursal::host {

/// Layers from `first` to `last`, both included, counted from 0.
struct LayerRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

}  // namespace unicursal::host
