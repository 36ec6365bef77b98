#include "host/spool/chunk_reader.hpp"

#include <algorithm>
#include <utility>

#include "host/spool/bytes.hpp"

namespace unicursal::host {

std::optional<SpooledChunk> ChunkReader::next() {
  const auto content = records_.next();
  if (!content) return std::nullopt;
  try {
    SpooledChunk chunk = chunk_from(*content);
    sound_ = records_.sound();
    first_line_ = std::exchange(next_line_, next_line_ + chunk.lines.size());
    return chunk;
  } catch (const DamagedBytes&) {
    return std::nullopt;  // whole, but not understood: damaged_within() compares what is sound
  }
}

bool ChunkReader::damaged_within() {
  return records_.sound() != sound_ ||
         records_.damaged_within(static_cast<unsigned char>(SpooledChunk::last_kind));
}

void SpoolExtent::add(const SpooledChunk& chunk) {
  ++chunks;
  last_begins = lines;
  lines += chunk.lines.size();
  if (chunk.kind == SpooledChunk::Kind::start) start_lines = lines;
  if (chunk.kind == SpooledChunk::Kind::layer) ++layers;
  if (chunk.kind == SpooledChunk::Kind::stretch) layers += chunk.begun.size();
  if (chunk.kind == SpooledChunk::Kind::rest) rest = true;
  if (chunk.kind == SpooledChunk::Kind::finish) finished = true;
}

LegReader::LegReader(const std::filesystem::path& chunks, Leg leg, std::uint64_t place)
    : reader_(chunks), leg_(std::move(leg)), line_(leg_.line(place)) {
  leading_ = place < leg_.lead_in.size();
  if (!leading_) return;
  lines_ = leg_.lead_in, given_ = place;
  mixture_ = mixture_before(chunks, leg_.begins_at);
}

/// Takes over the mixtures that start before the next line to be given.
void LegReader::start_mixtures() {
  for (const gcode::MixtureStart& start : mixtures_) {
    if (start.line < given_) mixture_ = start.name;
  }
}

bool LegReader::open_next() {
  while (auto chunk = reader_.next()) {
    layers_begun_ = layers_;
    if (chunk->kind == SpooledChunk::Kind::layer) ++layers_;
    if (chunk->kind == SpooledChunk::Kind::stretch) layers_ += chunk->begun.size();
    const std::uint64_t first = reader_.first_line();
    lines_ = std::move(chunk->lines);
    mixtures_ = std::move(chunk->mixtures);
    given_ = std::min<std::uint64_t>(lines_.size(), line_ - first);
    start_mixtures();
    if (given_ == lines_.size()) continue;
    leading_ = false;
    return true;
  }
  return false;
}

std::vector<std::string> LegReader::next(std::size_t most) {
  if (given_ == lines_.size() && !open_next()) return {};
  const std::size_t count = std::min(most, lines_.size() - given_);
  const auto begin = lines_.begin() + static_cast<std::ptrdiff_t>(given_);
  std::vector<std::string> batch(begin, begin + static_cast<std::ptrdiff_t>(count));
  given_ += count;
  start_mixtures();
  if (!leading_) line_ += count;
  return batch;
}

double LegReader::fraction() const {
  return lines_.empty() ? 0 : static_cast<double>(given_) / static_cast<double>(lines_.size());
}

gcode::ModalState state_at(const std::filesystem::path& chunks, const Leg& leg, std::uint64_t place) {
  gcode::ModalState state;
  const std::uint64_t until = leg.line(place);
  ChunkReader reader(chunks);
  std::uint64_t line = 0;
  const auto lead_in = [&] {
    if (leg.lead_in.empty()) return;
    state.position = {std::nullopt, std::nullopt, leg.height};
    const std::uint64_t count = std::min<std::uint64_t>(place, leg.lead_in.size());
    for (std::uint64_t i = 0; i < count; ++i) state.run(leg.lead_in[i]);
  };
  while (line < until) {
    const auto chunk = reader.next();
    if (!chunk) break;
    for (auto text = chunk->lines.begin(); text != chunk->lines.end() && line < until; ++text, ++line) {
      if (line == leg.begins_at) lead_in();
      state.run(*text);
    }
  }
  if (line == leg.begins_at) lead_in();
  return state;
}

std::string mixture_before(const std::filesystem::path& chunks, std::uint64_t line) {
  std::string mixture;
  ChunkReader reader(chunks);
  while (const auto chunk = reader.next()) {
    if (reader.first_line() >= line) break;
    for (const gcode::MixtureStart& start : chunk->mixtures) {
      if (reader.first_line() + start.line < line) mixture = start.name;
    }
  }
  return mixture;
}

std::optional<LayerPlace> layer_of(const std::filesystem::path& chunks, std::uint64_t line) {
  std::optional<LayerPlace> place;
  ChunkReader reader(chunks);
  std::size_t layers = 0;
  while (const auto chunk = reader.next()) {
    for (const LayerBegun& begun : chunk->begun) {
      if (reader.first_line() + begun.line > line) return place;
      place = LayerPlace{layers++, begun.top};
    }
  }
  return place;
}

}  // namespace unicursal::host
