#include "host/engine/source.hpp"

#include <utility>

#include "host/engine/seconds.hpp"

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

void report_printed(Source& source, const Clock& clock, double left) {
  source.printed(seconds(clock.now().time_since_epoch()), left);
}

std::vector<NamedMixture> PlannedSource::mixtures() const {
  std::vector<NamedMixture> mixtures;
  for (const MaterialVolume& material : run_.totals().materials)
    mixtures.push_back({material.name, material.intended});
  return mixtures;
}

std::optional<PrintStep> PlannedSource::next() {
  std::optional<PlannedLayer> layer = lookahead_.wait();
  PrintStep piece;
  if (!layer) {
    if (std::exchange(ended_, true)) return std::nullopt;
    piece.record.kind = SpooledChunk::Kind::rest;
    piece.chunk = run_.rest();
    return piece;
  }
  piece.record = record_of(*layer, run_.prepared());
  piece.ready_at = layer->ready_at;
  taken_ = piece.record.layer.index + 1;
  piece.chunk = run_.layer(std::move(*layer));
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
