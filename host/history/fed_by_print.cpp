#include "host/history/fed_by_print.hpp"

#include <algorithm>

#include "firmware_gcode/interruption/fed_filament.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

/// The places of the leg before `end`.
void run_leg(gcode::FedFilament& fed, const std::filesystem::path& chunks, const Leg& leg,
             std::uint64_t end) {
  const auto led = static_cast<std::size_t>(std::min<std::uint64_t>(end, leg.lead_in.size()));
  for (std::size_t i = 0; i < led; ++i) fed.run(leg.lead_in[i]);
  if (end <= leg.lead_in.size()) return;
  const std::uint64_t last = leg.line(end);
  ChunkReader reader(chunks);
  while (const std::optional<SpooledChunk> chunk = reader.next()) {
    std::uint64_t number = reader.first_line();
    if (number >= last) return;
    for (const std::string& line : chunk->lines) {
      if (number >= leg.begins_at && number < last) fed.run(line);
      ++number;
    }
  }
}

}  // namespace

gcode::PerFeeder fed_by_print(const std::filesystem::path& chunks, const JournalState& journal,
                              std::size_t feeders) {
  gcode::FedFilament fed(feeders);
  for (const GivenUpLeg& before : journal.given_up) run_leg(fed, chunks, before.leg, before.acknowledged);
  run_leg(fed, chunks, journal.leg, journal.handed);
  const bool parked = journal.aside || (journal.ended && journal.ended->outcome == LegOutcome::stopped);
  if (parked) {
    for (const std::string& line : journal.parking) fed.run(line);
  }
  return fed.turned();
}

std::size_t layers_passed(const std::filesystem::path& chunks, const JournalState& journal) {
  std::size_t begun = 0;
  ChunkReader reader(chunks);
  while (const std::optional<SpooledChunk> chunk = reader.next()) {
    if (reader.first_line() >= journal.furthest) break;
    for (const LayerBegun& layer : chunk->begun) begun += reader.first_line() + layer.line < journal.furthest;
    // What follows the last layer ends it.
    if (chunk->kind == SpooledChunk::Kind::finish) ++begun;
  }
  return begun == 0 ? 0 : begun - 1;
}

}  // namespace unicursal::host
