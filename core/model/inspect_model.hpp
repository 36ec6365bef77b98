// What a drawing or a file of meshes holds: its size, its bodies and colours, what was mended, and which
// zones a job for it could have.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/drawing/drawn_gradient.hpp"
#include "core/model/pose.hpp"

namespace unicursal::core {

/// A part of the model that could be a zone.
struct ZoneOffer {
  std::string select;  ///< what a job's zone would say
  std::string colour;  ///< "#rrggbb"; empty: the file names none
  double amount = 0;   ///< mm² of a drawing, mm³ of a mesh; what other bodies cover is counted
  bool paint = false;  ///< on a surface only
  std::optional<DrawnGradient> gradient;  ///< that the drawing gives this zone
};

struct ModelContents {
  bool drawing = false;
  Eigen::Vector3d size{0, 0, 0};  ///< mm; a drawing has no height
  std::size_t bodies = 0;         ///< solids, or islands of a drawing
  std::size_t holes = 0;          ///< of a drawing's islands
  std::size_t facets = 0;
  std::vector<ZoneOffer> zones;  ///< at least one
  std::vector<std::string> notes;
};

/// `paint_depth`: how deep the colour of a painted surface reaches, mm. Throws FileError or ModelError.
ModelContents inspect_model(const std::vector<std::filesystem::path>& files,
                            double paint_depth = usual_paint_depth);

}  // namespace unicursal::core
