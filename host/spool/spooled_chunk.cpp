#include "host/spool/spooled_chunk.hpp"

#include <cmath>

#include "host/spool/bytes.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t bead_bytes = 3 * 8 + 4;

void put(ByteWriter& bytes, const core::BeadPath& path) {
  bytes.put(static_cast<std::uint32_t>(path.size()));
  for (const core::Bead& bead : path.beads) {
    bytes.put(bead.position.x()).put(bead.position.y()).put(bead.area);
    bytes.put(static_cast<std::uint32_t>(bead.zone));
  }
}

double length_in(ByteReader& bytes) {
  const double value = bytes.number();
  if (!std::isfinite(value)) throw DamagedBytes("holds a length that is no number");
  return value;
}

core::BeadPath path_in(ByteReader& bytes) {
  core::BeadPath path;
  path.beads.resize(bytes.count(bead_bytes));
  for (core::Bead& bead : path.beads) {
    const double x = length_in(bytes), y = length_in(bytes);
    bead.position = {x, y};
    bead.area = length_in(bytes);
    bead.zone = bytes.take<std::uint32_t>();
  }
  return path;
}

core::Effort effort_in(ByteReader& bytes) {
  core::Effort effort(bytes.count(4));
  for (int& steps : effort) steps = static_cast<int>(bytes.take<std::uint32_t>());
  return effort;
}

}  // namespace

std::string to_bytes(const SpooledChunk& chunk) {
  ByteWriter bytes;
  bytes.put(static_cast<std::uint8_t>(chunk.kind)).put(static_cast<std::uint64_t>(chunk.layer.index));
  bytes.put(chunk.layer.top).put(chunk.layer.height);
  bytes.put(static_cast<std::uint32_t>(chunk.layer.paths.size()));
  for (const core::BeadPath& path : chunk.layer.paths) put(bytes, path);
  bytes.put(static_cast<std::uint32_t>(chunk.efforts.size()));
  for (const core::Effort& effort : chunk.efforts) {
    bytes.put(static_cast<std::uint32_t>(effort.size()));
    for (const int steps : effort) bytes.put(static_cast<std::uint32_t>(steps));
  }
  bytes.put(static_cast<std::uint32_t>(chunk.lines.size()));
  for (const std::string& line : chunk.lines) bytes.put(std::string_view(line));
  return bytes.bytes();
}

SpooledChunk chunk_from(std::string_view content) {
  ByteReader bytes(content);
  SpooledChunk chunk;
  const auto kind = bytes.take<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(SpooledChunk::Kind::finish)) throw DamagedBytes("is of no known kind");
  chunk.kind = static_cast<SpooledChunk::Kind>(kind);
  chunk.layer.index = bytes.take<std::uint64_t>();
  chunk.layer.top = length_in(bytes);
  chunk.layer.height = length_in(bytes);
  chunk.layer.paths.resize(bytes.count(4));
  for (core::BeadPath& path : chunk.layer.paths) path = path_in(bytes);
  chunk.efforts.resize(bytes.count(4));
  for (core::Effort& effort : chunk.efforts) effort = effort_in(bytes);
  chunk.lines.resize(bytes.count(4));
  for (std::string& line : chunk.lines) line = bytes.text();
  if (!bytes.empty()) throw DamagedBytes("holds more than it should");
  return chunk;
}

}  // namespace unicursal::host
