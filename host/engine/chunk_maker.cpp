#include "host/engine/chunk_maker.hpp"

#include <utility>

namespace unicursal::host {
namespace {

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void check_bare(const BareWatch& bare, const Job& job) {
  if (!bare.leaves_too_much() || job.allow_bare) return;
  throw core::DataError(job.file.string(), "part", bare.fault(),
                        "choose a smaller bead_width, scale the part, or accept it with part.allow_bare = "
                        "true or --allow-bare");
}

ChunkMaker::ChunkMaker(const PreparedJob& prepared)
    : prepared_(prepared),
      encoder_(prepared.job.profile.printer, print_settings(prepared)),
      start_(encoder_.start()) {
  note_warnings(start_);
}

ChunkMaker::Made ChunkMaker::layer(PlannedLayer planned) {
  bare_.look(planned);
  // A print that has begun is not given up for a layer of its own.
  if (planned.layer.index == prepared_.first) check_bare(bare_, prepared_.job);
  Made made;
  made.layer = placed(prepared_, planned);
  made.chunk = encoder_.layer(made.layer);
  note_warnings(made.chunk);
  if (listener_) listener_->layer_made(std::move(planned), made.layer, made.chunk);
  return made;
}

gcode::Chunk ChunkMaker::replay(const gcode::PlacedLayer& layer) {
  gcode::Chunk chunk = encoder_.layer(layer);
  note_warnings(chunk);
  return chunk;
}

gcode::Chunk ChunkMaker::rest() {
  return ended(encoder_.rest());
}

gcode::Chunk ChunkMaker::finish() {
  return ended(encoder_.finish());
}

gcode::Chunk ChunkMaker::ended(gcode::Chunk chunk) {
  note_warnings(chunk);
  if (listener_) listener_->end_made(chunk);
  return chunk;
}

double ChunkMaker::flow() const {
  const Job& job = prepared_.job;
  return job.print.speed ? *job.print.speed * job.bead_width * job.source.layer_height : encoder_.flow();
}

std::vector<std::string> ChunkMaker::warnings() const {
  std::vector<std::string> all = prepared_.job.warnings;
  append(all, prepared_.part->warnings());
  append(all, late_warnings());
  return all;
}

std::vector<std::string> ChunkMaker::late_warnings() const {
  std::vector<std::string> all = warnings_;
  if (const std::string warning = bare_.warning(); !warning.empty()) all.push_back(warning);
  if (listener_) append(all, listener_->warnings());
  return all;
}

void ChunkMaker::note_warnings(const gcode::Chunk& chunk) {
  append(warnings_, chunk.warnings);
}

}  // namespace unicursal::host
