#include "host/spool/spooled_chunk.hpp"

#include <cmath>
#include <cstdlib>

#include "host/spool/bytes.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t bead_bytes = 3 * 8 + 4;
constexpr std::size_t longest_name = 4096;  ///< bytes of a mixture's name

void put(ByteWriter& bytes, const core::BeadPath& path) {
  bytes.put(static_cast<std::uint32_t>(path.size()));
  for (const core::Bead& bead : path.beads) {
    bytes.put(bead.position.x()).put(bead.position.y()).put(bead.area);
    bytes.put(static_cast<std::uint32_t>(bead.zone));
  }
}

void put(ByteWriter& bytes, const core::Ring& ring) {
  bytes.put(static_cast<std::uint32_t>(ring.size()));
  for (const core::Vec2& v : ring) bytes.put(v.x()).put(v.y());
}

void put(ByteWriter& bytes, const core::Polygon& polygon) {
  put(bytes, polygon.outer);
  bytes.put(static_cast<std::uint32_t>(polygon.holes.size()));
  for (const core::Ring& hole : polygon.holes) put(bytes, hole);
}

double length_in(ByteReader& bytes) {
  const double value = bytes.number();
  if (!std::isfinite(value)) throw DamagedBytes("holds a length that is not a number");
  return value;
}

core::Ring ring_in(ByteReader& bytes) {
  core::Ring ring(bytes.count(2 * 8));
  for (core::Vec2& v : ring) {
    const double x = length_in(bytes), y = length_in(bytes);
    v = {x, y};
  }
  return ring;
}

core::Polygon polygon_in(ByteReader& bytes) {
  core::Polygon polygon;
  polygon.outer = ring_in(bytes);
  polygon.holes.resize(bytes.count(4));
  for (core::Ring& hole : polygon.holes) hole = ring_in(bytes);
  return polygon;
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

std::vector<LayerBegun> layers_begun_in(const std::vector<std::string>& lines) {
  static constexpr std::string_view mark = ";Z:";  // follows ;LAYER_CHANGE
  std::vector<LayerBegun> result;
  std::uint32_t commands = 0;
  for (const std::string& line : lines) {
    if (line.starts_with(mark))
      result.push_back({commands, std::strtod(line.c_str() + mark.size(), nullptr)});
    if (!line.empty() && line.front() != ';') ++commands;
  }
  return result;
}

std::string to_bytes(const SpooledChunk& chunk) {
  ByteWriter bytes;
  bytes.put(static_cast<std::uint8_t>(chunk.kind)).put(static_cast<std::uint64_t>(chunk.layer.index));
  bytes.put(chunk.layer.top).put(chunk.layer.height);
  bytes.put(static_cast<std::uint32_t>(chunk.layer.paths.size()));
  for (const core::BeadPath& path : chunk.layer.paths) put(bytes, path);
  bytes.put(static_cast<std::uint32_t>(chunk.layer.outlines.size()));
  for (const core::Polygon& outline : chunk.layer.outlines) put(bytes, outline);
  bytes.put(static_cast<std::uint32_t>(chunk.begun.size()));
  for (const LayerBegun& begun : chunk.begun) bytes.put(begun.line).put(begun.top);
  bytes.put(static_cast<std::uint32_t>(chunk.mixtures.size()));
  for (const gcode::MixtureStart& start : chunk.mixtures)
    bytes.put(static_cast<std::uint32_t>(start.line)).put(std::string_view(start.name));
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
  if (kind > static_cast<std::uint8_t>(SpooledChunk::last_kind)) throw DamagedBytes("is of no known kind");
  chunk.kind = static_cast<SpooledChunk::Kind>(kind);
  chunk.layer.index = bytes.take<std::uint64_t>();
  chunk.layer.top = length_in(bytes);
  chunk.layer.height = length_in(bytes);
  chunk.layer.paths.resize(bytes.count(4));
  for (core::BeadPath& path : chunk.layer.paths) path = path_in(bytes);
  chunk.layer.outlines.resize(bytes.count(8));
  for (core::Polygon& outline : chunk.layer.outlines) outline = polygon_in(bytes);
  chunk.begun.resize(bytes.count(4 + 8));
  for (LayerBegun& begun : chunk.begun) {
    begun.line = bytes.take<std::uint32_t>();
    begun.top = length_in(bytes);
  }
  chunk.mixtures.resize(bytes.count(4 + 4));
  for (gcode::MixtureStart& start : chunk.mixtures) {
    start.line = bytes.take<std::uint32_t>();
    start.name = bytes.text();
    if (start.name.size() > longest_name) throw DamagedBytes("holds a name that is too long");
  }
  chunk.efforts.resize(bytes.count(4));
  for (core::Effort& effort : chunk.efforts) effort = effort_in(bytes);
  chunk.lines.resize(bytes.count(4));
  for (std::string& line : chunk.lines) line = bytes.text();
  for (const gcode::MixtureStart& start : chunk.mixtures) {
    if (start.line >= chunk.lines.size()) throw DamagedBytes("starts a mixture after its last line");
  }
  if (!bytes.empty()) throw DamagedBytes("holds more than it should");
  return chunk;
}

}  // namespace unicursal::host
