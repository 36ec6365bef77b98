#include "host/engine/source.hpp"

#include <utility>

namespace unicursal::host {
namespace {

std::vector<core::Effort> efforts_of(const PlannedLayer& planned) {
  std::vector<core::Effort> efforts;
  for (const core::IslandPlan& plan : planned.plans) efforts.push_back(plan.effort);
  return efforts;
}

}  // namespace

std::vector<NamedMixture> PlannedSource::mixtures() const {
  std::vector<NamedMixture> mixtures;
  const std::vector<gcode::Material>& materials = maker_.prepared().job.print.materials;
  for (std::size_t i = 0; i < materials.size(); ++i)
    mixtures.push_back({materials[i].name, maker_.encoder().intended(i)});
  return mixtures;
}

std::optional<PrintStep> PlannedSource::next() {
  std::optional<PlannedLayer> layer = lookahead_.wait();
  PrintStep piece;
  if (!layer) {
    if (std::exchange(ended_, true)) return std::nullopt;
    piece.record.kind = SpooledChunk::Kind::rest;
    piece.chunk = maker_.rest();
    return piece;
  }
  piece.record.kind = SpooledChunk::Kind::layer;
  piece.record.efforts = efforts_of(*layer);
  piece.ready_at = layer->ready_at;
  ChunkMaker::Made made = maker_.layer(std::move(*layer));
  piece.record.layer = std::move(made.layer);
  piece.chunk = std::move(made.chunk);
  taken_ = piece.record.layer.index + 1;
  for (const gcode::LayerShare& share : piece.chunk.layers) {
    if (share.last) given_ = share.layer + 1;
  }
  return piece;
}

/// The encoder withholds a few layers, over which it chooses the route.
Waiting PlannedSource::waiting() const {
  Waiting waiting = lookahead_.waiting();
  if (ended_ || taken_ <= given_) return waiting;
  waiting.layers += taken_ - given_;
  waiting.seconds += foretold(given_, taken_).value_or(0);
  return waiting;
}

void PlannedSource::cancel() {
  ended_ = true;
  lookahead_.cancel();
}

std::optional<PrintStep> FinishedSource::next() {
  if (taken_ == print_.body.size()) return std::nullopt;
  return PrintStep{print_.body[taken_++], {}, 0};
}

Waiting FinishedSource::waiting() const {
  Waiting waiting{print_.body.size() - taken_, 0};
  for (std::size_t i = taken_; i < print_.body.size(); ++i) waiting.seconds += print_.body[i].seconds;
  return waiting;
}

}  // namespace unicursal::host
