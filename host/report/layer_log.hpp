// A report whose list of layers is written while the print runs, so that memory does not grow with it.
// The file appears under its name only when it is whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

class LayerLog {
 public:
  /// Throws core::FileError when the file cannot be made.
  explicit LayerLog(std::filesystem::path file);
  /// Removes what was written unless finish() was called.
  ~LayerLog();
  LayerLog(const LayerLog&) = delete;
  LayerLog& operator=(const LayerLog&) = delete;

  void add(const nlohmann::json& layer);
  /// Writes the rest: every key of the object `rest` beside "layers". Throws core::FileError.
  void finish(const nlohmann::json& rest);

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  std::size_t layers_ = 0;
  bool finished_ = false;
};

/// Writes a whole JSON file; it appears under its name only when it is complete. Throws core::FileError.
void write_json(const std::filesystem::path& file, const nlohmann::json& value);

}  // namespace unicursal::host
