#include "sim/bed/deposit.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {

constexpr double travel_in_bead_widths = 1.5;  // a shorter way without laying anything is no travel

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
  if (layers_.empty()) first_start_ = bead.start;
  if (layers_.empty() || layers_.back().z != bead.to.z) begin_layer(bead.to.z);
  DepositedLayer& layer = layers_.back();
  settle_travel(layer);
  const double length = in_plane(bead.from, bead.to);
  ++layer.beads;
  layer.length += length;
  layer.volume += bead.volume;
  length_ += length;
  volume_ += bead.volume;
  last_end_ = bead.end;
  extents_.include(bead.from);
  extents_.include(bead.to);
  last_width_ = layer.height > 0 ? bead.volume / (length * layer.height) : 0;
  if (drawing_ != nullptr) drawing_->bead(layers_.size() - 1, bead, last_width_);
}

void Deposit::travelled(const Position& from, const Position& to) {
  travel_ += in_plane(from, to);
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
}

void Deposit::settle_travel(DepositedLayer& layer) {
  if (travel_ > travel_in_bead_widths * last_width_) {
    layer.travel += travel_;
    ++layer.travels;
  }
  travel_ = 0;
}

}  // namespace unicursal::sim
