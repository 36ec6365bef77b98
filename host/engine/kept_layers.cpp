#include "host/engine/kept_layers.hpp"

#include <algorithm>

#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {

KeptLayers::KeptLayers(const std::filesystem::path& chunks) {
  ChunkReader reader(chunks);
  while (const auto chunk = reader.next()) {
    for (const LayerBegun& begun : chunk->begun) begins_.push_back(reader.first_line() + begun.line);
    end_ = reader.first_line() + chunk->lines.size();
  }
}

std::size_t KeptLayers::before(std::uint64_t line) const {
  const auto begun = std::upper_bound(begins_.begin(), begins_.end(), line) - begins_.begin();
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(begun - 1, 0));
}

double KeptLayers::fraction(std::uint64_t line) const {
  const std::size_t layer = before(line);
  if (layer >= begins_.size() || line <= begins_[layer]) return 0;
  const std::uint64_t end = layer + 1 < begins_.size() ? begins_[layer + 1] : end_;
  return static_cast<double>(line - begins_[layer]) /
         static_cast<double>(std::max(end, line) - begins_[layer]);
}

}  // namespace unicursal::host
