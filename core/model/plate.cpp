#include "core/model/plate.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

namespace unicursal::core {
namespace {

void move(Polygon& polygon, const Vec2& offset) {
  for (Vec2& vertex : polygon.outer) vertex += offset;
  for (Ring& hole : polygon.holes) {
    for (Vec2& vertex : hole) vertex += offset;
  }
}

Layer moved(Layer layer, const Vec2& offset) {
  for (Island& island : layer.islands) {
    move(island.outline, offset);
    for (ZoneRegion& region : island.zones) {
      for (Polygon& polygon : region.polygons) move(polygon, offset);
    }
  }
  return layer;
}

/// What both kinds of plates share.
class Items : public Part {
 public:
  explicit Items(std::vector<PlateItem> items) : items_(std::move(items)) {
    for (const PlateItem& item : items_) {
      if (!highest_ || item.part->layer_count() > highest_->layer_count()) highest_ = item.part.get();
      const Box own = item.part->extent();
      extent_ = &item == items_.data() ? Box{own.min + item.offset, own.max + item.offset}
                                       : Box{extent_.min.cwiseMin(own.min + item.offset),
                                             extent_.max.cwiseMax(own.max + item.offset)};
      for (const std::string& warning : item.part->warnings()) {
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
          warnings_.push_back(warning);
      }
    }
  }

  Box extent() const override { return extent_; }
  double height() const override { return highest_->height(); }
  const std::vector<Zone>& zones() const override { return highest_->zones(); }
  const std::vector<std::string>& warnings() const override { return warnings_; }

 protected:
  const std::vector<PlateItem>& items() const { return items_; }
  const Part& highest() const { return *highest_; }

 private:
  std::vector<PlateItem> items_;
  const Part* highest_ = nullptr;
  Box extent_;
  std::vector<std::string> warnings_;
};

class Plate final : public Items {
 public:
  using Items::Items;

  std::size_t layer_count() const override { return highest().layer_count(); }
  Layer layer(std::size_t index) const override {
    Layer result;
    const Part* known = nullptr;  // copies of a part are sliced once
    Layer layer;
    for (const PlateItem& item : items()) {
      if (index >= item.part->layer_count()) continue;
      if (item.part.get() != known) layer = item.part->layer(index), known = item.part.get();
      Layer copy = moved(layer, item.offset);
      std::vector<Island> islands = std::move(result.islands);
      islands.insert(islands.end(), std::make_move_iterator(copy.islands.begin()),
                     std::make_move_iterator(copy.islands.end()));
      if (result.height == 0 || item.part.get() == &highest()) {
        result = std::move(copy);
      }
      result.islands = std::move(islands);
    }
    std::stable_sort(result.islands.begin(), result.islands.end(),
                     [](const Island& a, const Island& b) { return area(a.outline) > area(b.outline); });
    return result;
  }
};

class PlateInTurn final : public Items {
 public:
  explicit PlateInTurn(std::vector<PlateItem> all) : Items(std::move(all)) {
    for (const PlateItem& item : items()) ends_.push_back(layer_count() + item.part->layer_count());
  }

  std::size_t layer_count() const override { return ends_.empty() ? 0 : ends_.back(); }
  Layer layer(std::size_t index) const override {
    const auto end = std::upper_bound(ends_.begin(), ends_.end(), index);
    const PlateItem& item = items()[static_cast<std::size_t>(end - ends_.begin())];
    Layer layer = moved(item.part->layer(index - (*end - item.part->layer_count())), item.offset);
    layer.index = index;
    return layer;
  }

 private:
  std::vector<std::size_t> ends_;  ///< per item: layers up to its last one
};

struct Rows {
  std::vector<Vec2> corners;
  Vec2 size{0, 0};
};

/// Fills rows of this width, the deepest rectangles first.
Rows rows_of(const std::vector<Vec2>& sizes, double width, double gap) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sizes[a].y() > sizes[b].y(); });
  Rows rows;
  rows.corners.resize(sizes.size());
  double x = 0, y = 0, deepest = 0;
  for (const std::size_t i : order) {
    if (x > 0 && x + sizes[i].x() > width) {
      x = 0;
      y += deepest + gap;
      deepest = 0;
    }
    rows.corners[i] = {x, y};
    rows.size = rows.size.cwiseMax(rows.corners[i] + sizes[i]);
    deepest = std::max(deepest, sizes[i].y());
    x += sizes[i].x() + gap;
  }
  return rows;
}

}  // namespace

std::unique_ptr<const Part> plate_of(std::vector<PlateItem> items) {
  return std::make_unique<Plate>(std::move(items));
}

std::unique_ptr<const Part> plate_in_turn(std::vector<PlateItem> items) {
  return std::make_unique<PlateInTurn>(std::move(items));
}

std::optional<std::vector<Vec2>> arranged(const std::vector<Vec2>& sizes, const Vec2& bed, double gap) {
  constexpr int widths = 64;  // that are tried
  std::optional<Rows> best;
  for (int i = 1; i <= widths; ++i) {
    Rows rows = rows_of(sizes, bed.x() * i / widths, gap);
    if (rows.size.x() > bed.x() || rows.size.y() > bed.y()) continue;
    if (!best || rows.size.maxCoeff() < best->size.maxCoeff()) best = std::move(rows);
  }
  if (!best) return std::nullopt;
  return best->corners;
}

}  // namespace unicursal::core
