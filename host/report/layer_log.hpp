// A report whose list of layers is written while the print runs, so that memory does not grow with it.
// The file appears under its name when it is complete (whole_file.hpp); without finish() it is removed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/files/whole_file.hpp"

namespace unicursal::host {

class LayerLog {
 public:
  /// Throws core::FileError when the file cannot be made.
  explicit LayerLog(std::filesystem::path file);
  void add(const nlohmann::json& layer);
  /// Once. Writes the rest: every key of the object `rest` beside "layers". Throws core::FileError.
  void finish(const nlohmann::json& rest);

 private:
  WholeFile file_;
  std::size_t layers_ = 0;
};

/// Writes a whole JSON file; it appears under its name only when it is complete. Throws core::FileError.
void write_json(const std::filesystem::path& file, const nlohmann::json& value);

}  // namespace unicursal::host
