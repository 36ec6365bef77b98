#include "host/engine/progress.hpp"

#include <algorithm>

namespace unicursal::host {
namespace {

constexpr double no_time = 0;

/// The layer that is printed when `seconds` of a chunk have passed; nullopt if the chunk has no layers.
std::optional<std::size_t> layer_at(const std::vector<gcode::LayerShare>& layers, double seconds) {
  if (layers.empty()) return std::nullopt;
  for (const gcode::LayerShare& share : layers) {
    seconds -= share.seconds;
    if (seconds < 0) return share.layer;
  }
  return layers.back().layer;
}

}  // namespace

Progress Progress::resumed(std::size_t layers_kept) {
  Progress progress;
  progress.resumed_ = true;
  progress.layers_kept_ = progress.layers_done_ = layers_kept;
  return progress;
}

void Progress::replay(std::size_t layers_begun, double fraction) {
  replaying_ = true;
  layers_begun_ = layers_begun;
  fraction_ = fraction;
}

void Progress::end_replay() {
  // What was withheld of the last layer follows with the next chunk.
  if (replaying_) layers_done_ = measured_from_ = std::max<std::size_t>(layers_begun_ + 1, 1);
  replaying_ = false;
  fraction_ = 0;
}

void Progress::note_ends(const gcode::Chunk& chunk) {
  if (chunk.layers.empty() && chunk.seconds > 0) ++layers_done_;
  for (const gcode::LayerShare& share : chunk.layers) {
    if (share.last) layers_done_ = std::max(layers_done_, share.layer + 1);
  }
}

void Progress::begin_chunk(const gcode::Chunk& chunk, double flow) {
  chunk_seconds_ = chunk.seconds;
  chunk_layers_ = chunk.layers;
  measure_layers(chunk, flow);
  note_ends(chunk);
  layers_begun_ = layer_at(chunk_layers_, 0).value_or(layers_begun_);
}

/// The print's first layer is not a measure for the others: it has its own speed and a skirt. Priming does
/// not belong to any layer.
void Progress::measure_layers(const gcode::Chunk& chunk, double flow) {
  if (flow > 0) unfinished_seconds_ -= chunk.prime_volume / flow;
  for (const gcode::LayerShare& share : chunk.layers) {
    unfinished_seconds_ += share.seconds;
    if (!share.last) continue;
    if (share.layer >= measured_from_) measured_seconds_ += unfinished_seconds_;
    unfinished_seconds_ = 0;
  }
}

void Progress::sent(double fraction) {
  fraction_ = fraction;
  layers_begun_ = layer_at(chunk_layers_, fraction * chunk_seconds_).value_or(layers_begun_);
}

void Progress::end_chunk() {
  seconds_sent_ += chunk_seconds_;
  layers_sent_ += layers_ended_in_chunk();
  chunk_seconds_ = fraction_ = 0;
  chunk_layers_.clear();
}

/// A chunk without layers, as prints that need no planning have them, counts as one.
std::size_t Progress::layers_ended_in_chunk() const {
  if (chunk_layers_.empty()) return chunk_seconds_ > 0 ? 1 : 0;
  return static_cast<std::size_t>(std::count_if(chunk_layers_.begin(), chunk_layers_.end(),
                                                [](const gcode::LayerShare& share) { return share.last; }));
}

bool Progress::has_begun() const {
  return chunk_seconds_ > 0 || layers_begun_ > 0 || layers_sent_ > 0;
}

std::size_t Progress::layer(std::size_t layers) const {
  return has_begun() ? std::min(layers_begun_ + 1, layers) : 0;
}

double Progress::seconds_left(const Ahead& ahead) const {
  if (replaying_) {
    const double this_layer = ahead.foretold(layers_begun_, layers_begun_ + 1).value_or(0);
    return ahead.foretold(layers_begun_, ahead.layers).value_or(0) - fraction_ * this_layer;
  }
  const std::size_t sent = layers_sent_ + layers_ended_in_chunk();
  const std::size_t done = layers_done_;
  if (const auto rest = ahead.foretold(done, ahead.layers)) {
    const double foretold = ahead.foretold(std::min(measured_from_, done), done).value_or(0);
    const double stretch = foretold > 0 && measured_seconds_ > 0 ? measured_seconds_ / foretold : 1;
    return chunk_seconds_left() + std::max(stretch * *rest - unfinished_seconds_, no_time);
  }
  const std::size_t known = sent + ahead.waiting.layers;
  const double sum = seconds_sent_ + chunk_seconds_ + ahead.waiting.seconds;
  const double mean = known > 0 ? sum / static_cast<double>(known) : sum;
  const std::size_t unknown = ahead.layers - std::min(ahead.layers, done + ahead.waiting.layers);
  return chunk_seconds_left() + ahead.waiting.seconds + mean * static_cast<double>(unknown);
}

double Progress::percent(const Ahead& ahead, bool done) const {
  const double left = seconds_left(ahead);
  double sent = seconds_sent_ + chunk_seconds_ * fraction_;
  if (resumed_) sent = std::max(ahead.foretold(0, ahead.layers).value_or(0) - left, no_time);
  const double whole = done ? sent : sent + left;
  if (whole > 0) highest_percent_ = std::max(highest_percent_, 100 * sent / whole);
  return highest_percent_;
}

}  // namespace unicursal::host
