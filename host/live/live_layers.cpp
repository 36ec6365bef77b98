#include "host/live/live_layers.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace unicursal::host {

void LiveLayers::begin(double top) {
  end();
  const double below = layers_.empty() ? 0 : layers_.back().top;
  Layer next;
  next.top = top;
  next.height = top > below ? top - below : top;  // the first one of a further part lies on the bed
  next.revision = revision_;
  layers_.push_back(std::move(next));
}

void LiveLayers::end() {
  if (layers_.empty()) return;
  layers_.back().complete = layers_.back().changed = true;
  planned_.erase(planned_.begin(), planned_.lower_bound(layers_.size()));
}

LaidPath& LiveLayers::path(const core::Vec2& from) {
  assert(!layers_.empty());
  Layer& layer = layers_.back();
  if (!layer.path) {
    layer.path.emplace(from);
    layer.first = layer.path->first();
  }
  layer.changed = true;
  return *layer.path;
}

std::vector<KnownLayer> LiveLayers::take_changed() {
  std::vector<KnownLayer> changed;
  for (std::size_t i = 0; i < layers_.size(); ++i)
    if (std::exchange(layers_[i].changed, false)) changed.push_back(layers_[i].known(i));
  for (auto& [number, layer] : planned_)
    if (number >= layers_.size() && std::exchange(layer.changed, false))
      changed.push_back({number, layer.top, layer.path.size(), false, true});
  return changed;
}

void LiveLayers::plan(std::size_t layer, double top, LaidPath path) {
  if (layer >= layers_.size()) planned_.insert_or_assign(layer, Planned{top, std::move(path), true});
}

void LiveLayers::back_to(const Mark& mark) {
  ++revision_;
  layers_.resize(std::min(layers_.size(), mark.layers));
  if (layers_.empty()) return;
  Layer& last = layers_.back();
  if (last.path) last.path->cut(mark.beads);
  if (last.path && mark.beads == 0) last.path.reset();
  last.complete = false;
  last.changed = true;
  last.revision = revision_;
}

std::vector<KnownLayer> LiveLayers::known() const {
  std::vector<KnownLayer> known;
  for (std::size_t i = 0; i < layers_.size(); ++i)
    if (!layers_[i].lost) known.push_back(layers_[i].known(i));
  for (const auto& [number, layer] : planned_)
    if (number >= layers_.size()) known.push_back({number, layer.top, layer.path.size(), false, true});
  return known;
}

std::optional<LiveLayers::Found> LiveLayers::find(std::size_t number) const {
  if (number >= layers_.size()) {
    std::optional<PathPiece> plan = plan_of(number);
    if (!plan) return std::nullopt;
    return Found{std::move(*plan), std::nullopt};
  }
  const Layer& layer = layers_[number];
  if (layer.lost) return std::nullopt;
  return Found{{layer.known(number), 0, layer.first, layer.revision, layer.path ? layer.path->bytes() : ""},
               layer.offset};
}

std::optional<PathPiece> LiveLayers::piece(Found found, std::size_t from) const {
  PathPiece& piece = found.piece;
  if (found.offset) {
    piece.records.resize(piece.beads * LaidPath::record);
    const ssize_t read =
        ::pread(file_.get(), piece.records.data(), piece.records.size(), static_cast<off_t>(*found.offset));
    if (read != static_cast<ssize_t>(piece.records.size())) return std::nullopt;
  }
  piece.keep_from(from);
  return std::move(piece);
}

std::optional<PathPiece> LiveLayers::plan_of(std::size_t number) const {
  const auto found = planned_.find(number);
  if (found == planned_.end()) return std::nullopt;
  const auto& [top, path, changed] = found->second;
  return PathPiece{{number, top, path.size(), false, true}, 0, path.first(), 0, path.bytes()};
}

void PathPiece::keep_from(std::size_t from) {
  first = std::min(from, beads);
  begin = LaidPath::begin_of(records, begin, first);
  records.erase(0, first * LaidPath::record);
}

std::optional<std::size_t> LiveLayers::next_to_move(std::size_t number) {
  std::size_t bytes = 0;
  for (std::size_t i = moved_; i < layers_.size(); ++i) bytes += layers_[i].beads() * LaidPath::record;
  for (; moved_ < std::min(number, layers_.size()) && bytes > most_in_memory; ++moved_) {
    const Layer& layer = layers_[moved_];
    if (!layer.complete) break;
    bytes -= layer.beads() * LaidPath::record;
    if (layer.path) return moved_;
  }
  return std::nullopt;
}

/// The file has no name, so that nothing is left of it however this program ends.
std::optional<std::uint64_t> LiveLayers::write_out(std::size_t number) {
  if (!file_ && !no_file_ && !folder_.empty())
    file_.reset(::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  no_file_ = !file_;
  const std::string& bytes = layers_[number].path->bytes();
  const ssize_t written =
      file_ ? ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(file_size_)) : -1;
  if (written != static_cast<ssize_t>(bytes.size())) return std::nullopt;
  return std::exchange(file_size_, file_size_ + bytes.size());
}

void LiveLayers::moved(std::size_t number, std::optional<std::uint64_t> offset) {
  Layer& layer = layers_[number];
  layer.offset = offset;
  layer.lost = !offset;
  if (offset) layer.on_disk = layer.path->size();
  layer.path.reset();
}

}  // namespace unicursal::host
