// A drawing extruded to a height: every layer has the same islands.
#pragma once

#include <filesystem>
#include <memory>

#include "core/drawing/svg_reader.hpp"
#include "core/model/part.hpp"
#include "core/model/pose.hpp"

namespace unicursal::core {

/// Reads a drawing that holds at least one area. Throws FileError or ModelError.
Drawing read_drawing(const std::filesystem::path& file, Warnings& warnings,
                     const DrawingOptions& options = {});

/// Precondition: `source.files` holds one SVG. `matched`: see read_part(). Throws FileError or NotedError.
std::unique_ptr<const Part> read_drawing_part(const PartSource& source, const Pose& pose,
                                              std::vector<bool>* matched);

}  // namespace unicursal::core
