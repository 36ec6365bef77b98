#include "host/engine/source.hpp"

#include <utility>

namespace unicursal::host {
namespace {

SpooledChunk record_of(const PlannedLayer& planned, const PreparedJob& prepared) {
  SpooledChunk record;
  record.kind = SpooledChunk::Kind::layer;
  record.layer = placed(prepared, planned);
  for (const core::IslandPlan& plan : planned.plans) record.efforts.push_back(plan.effort);
  return record;
}

}  // namespace

std::vector<NamedMixture> PlannedSource::mixtures() const {
  std::vector<NamedMixture> mixtures;
  for (const MaterialVolume& material : run_.totals().materials)
    mixtures.push_back({material.name, material.intended});
  return mixtures;
}

std::optional<Piece> PlannedSource::next() {
  std::optional<PlannedLayer> layer = lookahead_.wait();
  Piece piece;
  if (!layer) {
    if (std::exchange(ended_, true)) return std::nullopt;
    piece.record.kind = SpooledChunk::Kind::rest;
    piece.chunk = run_.rest();
    return piece;
  }
  piece.record = record_of(*layer, run_.prepared());
  piece.ready_at = layer->ready_at;
  piece.chunk = run_.layer(std::move(*layer));
  return piece;
}

void PlannedSource::cancel() {
  ended_ = true;
  lookahead_.cancel();
}

std::optional<Piece> FinishedSource::next() {
  if (taken_ == print_.body.size()) return std::nullopt;
  return Piece{print_.body[taken_++], {}, 0};
}

Waiting FinishedSource::waiting() const {
  Waiting waiting{print_.body.size() - taken_, 0};
  for (std::size_t i = taken_; i < print_.body.size(); ++i) waiting.seconds += print_.body[i].seconds;
  return waiting;
}

}  // namespace unicursal::host
