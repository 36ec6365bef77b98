// Where a picture lies on the bed, so that pictures of one layer can be shown in one frame. mm.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/numeric/vec2.hpp"

namespace unicursal::host {

struct PicturePlace {
  core::Vec2 corner{0, 0};  ///< the upper left one
  double pixel = 0;         ///< side of a pixel
};

/// [left, top, side of a pixel]
nlohmann::json to_json(const PicturePlace& place);

}  // namespace unicursal::host
