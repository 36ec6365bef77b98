// Reads model files into a part that slices itself.
#pragma once

#include <memory>
#include <vector>

#include "core/model/file_kind.hpp"
#include "core/model/part.hpp"
#include "core/model/pose.hpp"

namespace unicursal::core {

/// The files beside a model that belong to it: the material files of an OBJ file. Throws FileError if the
/// model cannot be read.
std::vector<std::filesystem::path> companion_files(const std::filesystem::path& file);

/// Reads, shapes and checks the files. Throws FileError or ModelError. `matched`, one for each zone: if it is
/// given, a zone that selects nothing is not refused, and the others are marked there.
std::unique_ptr<const Part> read_part(const PartSource& source, const Shaping& shaping = {},
                                      std::vector<bool>* matched = nullptr);

}  // namespace unicursal::core
