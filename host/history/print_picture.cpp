#include "host/history/print_picture.hpp"

#include "core/picture/png_bytes.hpp"
#include "host/engine/planned_production.hpp"
#include "host/engine/sliced_production.hpp"
#include "host/report/small_picture.hpp"
#include "host/report/target.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

std::string first_layer(const PreparedJob& prepared, const std::filesystem::path& chunks) {
  ChunkReader reader(chunks);
  while (const auto chunk = reader.next()) {
    if (chunk->kind == SpooledChunk::Kind::layer && !chunk->layer.paths.empty())
      return picture::png_bytes(small_picture(chunk->layer, curve_style(prepared)));
  }
  return {};
}

}  // namespace

std::string print_picture(const Production& production, const std::filesystem::path& chunks) noexcept {
  try {
    if (const auto* const sliced = dynamic_cast<const SlicedProduction*>(&production))
      return picture::png_bytes(small_picture(sliced->prepared()));
    if (const auto* const planned = dynamic_cast<const PlannedProduction*>(&production))
      return first_layer(planned->prepared(), chunks);
  } catch (...) {
    // The history does without.
  }
  return {};
}

}  // namespace unicursal::host
