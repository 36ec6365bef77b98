// Where the layers lie in the lines that a spool has kept, for the progress of a resumed print. What was
// withheld of the last layer is not there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace unicursal::host {

class KeptLayers {
 public:
  /// `chunks`: the spool's file.
  explicit KeptLayers(const std::filesystem::path& chunks);

  /// Layers before the one that a print's line belongs to.
  std::size_t before(std::uint64_t line) const;
  /// The share of that layer's kept lines that precede the line, 0 … 1.
  double fraction(std::uint64_t line) const;

 private:
  std::vector<std::uint64_t> begins_;  ///< first line of each layer
  std::uint64_t end_ = 0;
};

}  // namespace unicursal::host
