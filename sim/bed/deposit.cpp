#include "sim/bed/deposit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::sim {

namespace {

constexpr double travel_in_bead_widths = 1.5;  // a shorter movement without a bead is not a travel

double in_plane(const Position& a, const Position& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace

void Extents::include(const Position& place) {
  min_x = std::min(min_x, place.x);
  min_y = std::min(min_y, place.y);
  min_z = std::min(min_z, place.z);
  max_x = std::max(max_x, place.x);
  max_y = std::max(max_y, place.y);
  max_z = std::max(max_z, place.z);
}

void Deposit::laid(const Bead& bead) {
  for (std::size_t f = 0; f < max_feeders; ++f) by_feeder_[f] += bead.shares[f] * bead.volume;
  const double length = in_plane(bead.from, bead.to);
  if (length == 0) return drop(bead);
  if (takers_.strikes != nullptr) takers_.strikes->laid(bead.from, bead.to);
  if (layers_.empty()) first_start_ = bead.start;
  if (layers_.empty() || layers_.back().z != bead.to.z) begin_layer(bead.to.z);
  DepositedLayer& layer = layers_.back();
  settle_travel(layer);
  ++layer.beads;
  layer.length += length;
  layer.seconds += bead.end - bead.start;
  layer.volume += bead.volume;
  length_ += length;
  volume_ += bead.volume;
  last_end_ = bead.end;
  extents_.include(bead.from);
  extents_.include(bead.to);
  last_width_ = layer.height > 0 ? bead.volume / (length * layer.height) : 0;
  if (takers_.drawing != nullptr) takers_.drawing->bead(layers_.size() - 1, layer, bead, last_width_);
  if (takers_.spread != nullptr && layer.height > 0) takers_.spread->lay(bead, last_width_);
}

void Deposit::drop(const Bead& bead) {
  dropped_ += bead.volume;
  if (takers_.spread == nullptr || layers_.empty() || layers_.back().z != bead.to.z) return;
  const double height = layers_.back().height;
  if (height > 0) takers_.spread->lay(bead, 2 * std::sqrt(bead.volume / (std::numbers::pi * height)));
}

void Deposit::finish() {
  if (takers_.spread == nullptr || takers_.spread->empty()) return;
  if (takers_.rasters != nullptr) takers_.rasters->layer(takers_.spread->raster());
  takers_.spread->begin(0, 0);
}

void Deposit::travelled(const Position& from, const Position& to) {
  travel_ += in_plane(from, to);
  if (takers_.strikes != nullptr) takers_.strikes->travelled(from, to);
}

void Deposit::begin_layer(double z) {
  double below = layers_.empty() ? 0 : layers_.back().z;
  if (below > z) {
    below = 0;
    for (const DepositedLayer& layer : layers_) {
      if (layer.z < z) below = std::max(below, layer.z);
    }
  }
  DepositedLayer layer;
  layer.z = z;
  layer.height = z - below;
  layers_.push_back(layer);
  finish();
  if (takers_.spread != nullptr) takers_.spread->begin(layer.z, layer.height);
}

void Deposit::settle_travel(DepositedLayer& layer) {
  if (travel_ > travel_in_bead_widths * last_width_) {
    layer.travel += travel_;
    ++layer.travels;
  }
  travel_ = 0;
}

}  // namespace unicursal::sim
