#include "host/engine/source.hpp"

#include <utility>

#include "host/engine/seconds.hpp"

namespace unicursal::host {
namespace {

std::vector<core::Effort> efforts_of(const PlannedLayer& planned) {
  std::vector<core::Effort> efforts;
  for (const core::IslandPlan& plan : planned.plans) efforts.push_back(plan.effort);
  return efforts;
}

}  // namespace

void report_printed(Source& source, const Clock& clock, double left) {
  source.printed(seconds(clock.now().time_since_epoch()), left);
}

std::optional<PrintStep> PlannedSource::next() {
  std::optional<PlannedLayer> layer = lookahead_.wait();
  PrintStep step;
  if (!layer) {
    if (std::exchange(ended_, true)) return std::nullopt;
    step.record.kind = SpooledChunk::Kind::rest;
    step.chunk = maker_.rest();
    ++made_;
    return step;
  }
  step.record.kind = SpooledChunk::Kind::layer;
  step.record.efforts = efforts_of(*layer);
  step.ready_at = layer->ready_at;
  ChunkMaker::Made made = maker_.layer(std::move(*layer));
  step.record.layer = std::move(made.layer);
  step.chunk = std::move(made.chunk);
  ++made_;
  taken_ = step.record.layer.index + 1;
  for (const gcode::LayerShare& share : step.chunk.layers) {
    if (share.last) given_ = share.layer + 1;
  }
  return step;
}

/// The encoder withholds a few layers, since it chooses the route over them together.
Waiting PlannedSource::waiting() const {
  Waiting waiting = lookahead_.waiting();
  if (ended_ || taken_ <= given_) return waiting;
  waiting.layers += taken_ - given_;
  waiting.seconds += foretold(given_, taken_).value_or(0);
  return waiting;
}

void PlannedSource::cancel() {
  ended_ = cancelled_ = true;
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
