#include "sim/bed/bead_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "sim/bed/pen.hpp"

namespace unicursal::sim {

namespace {

constexpr picture::Colour background{250, 249, 246};
constexpr double margin = 1;           // mm around the print
constexpr double longest_side = 4096;  // pixels of a layer's picture
constexpr double part_side = 1600;     // pixels of the part's picture
constexpr double finest_part = 16;     // pixels per mm in the part's picture, at most
constexpr Ink wall{0.36, 0.36};        // side of a layer
constexpr Ink seam{0.2, 0.2};          // foot of a layer, so that layers are distinguishable
constexpr Ink top{0.6, 1};

std::size_t pixels(double count, double most) {
  return static_cast<std::size_t>(std::clamp(std::ceil(count), 1.0, most));
}

struct View {
  Projection projection;
  std::size_t width = 1, height = 1;
  PicturePlace place;
};

View from_above(const Extents& extents, double pixel, double around) {
  const double width = extents.max_x - extents.min_x + 2 * around;
  const double height = extents.max_y - extents.min_y + 2 * around;
  const double scale = std::min(1 / pixel, longest_side / std::max(width, height));
  const PicturePlace place{extents.min_x - around, extents.max_y + around, 1 / scale};
  const Projection projection{{-place.left * scale, place.top * scale}, {scale, 0}, {0, -scale}};
  return {projection, pixels(width * scale, longest_side), pixels(height * scale, longest_side), place};
}

View view_of(const BeadStore& store, double pixel) {
  return from_above(store.part(), pixel, margin + std::min(store.widest() / 2, margin));
}

bool holds(const Extents& box, const StoredBead& bead) {
  constexpr double rounding = 0.01;  // mm; beads are stored with fewer digits
  return bead.x0 > box.min_x - rounding && bead.x0 < box.max_x + rounding && bead.y0 > box.min_y - rounding &&
         bead.y0 < box.max_y + rounding;
}

/// x runs to the right and away from the viewer, y to the left and away; both at 30° to the horizontal.
class CornerView {
 public:
  /// Shows the part and the walls below it; `around` mm of margin.
  CornerView(BeadStore& store, double around) {
    const Extents part = store.part();
    store.for_each([&](std::size_t layer, const StoredBead& bead) {
      if (!holds(part, bead)) return;
      include(bead.x0, bead.y0, store.layers()[layer].z);
      include(bead.x0, bead.y0, 0);
    });
    left_ -= around, right_ += around, bottom_ -= around, top_ += around;
    scale = std::min(finest_part, part_side / std::max(right_ - left_, top_ - bottom_));
    width = pixels((right_ - left_) * scale, part_side);
    height = pixels((top_ - bottom_) * scale, part_side);
  }

  Projection at(double z) const {
    return {
        {-left_ * scale, (top_ - z) * scale}, {across * scale, -up * scale}, {-across * scale, -up * scale}};
  }

  double scale = 1;  ///< Pixels per mm.
  std::size_t width = 1, height = 1;

 private:
  static constexpr double across = std::numbers::sqrt3 / 2, up = 0.5;

  void include(double x, double y, double z) {
    const double sideways = (x - y) * across, high = (x + y) * up + z;
    left_ = std::min(left_, sideways), right_ = std::max(right_, sideways);
    bottom_ = std::min(bottom_, high), top_ = std::max(top_, high);
  }

  double left_ = 1e9, right_ = -1e9, bottom_ = 1e9, top_ = -1e9;  ///< Extents of the projection, mm.
};

}  // namespace

void clear_pictures(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if ((name.starts_with("deposit-") && name.ends_with(".png")) || name == "part.png" ||
        name == "motion.png")
      old.push_back(entry.path());
  }
  for (const auto& file : old) std::filesystem::remove(file);
}

PicturePlace place_of_layers(const BeadStore& store, double pixel) {
  if (store.layers().empty()) return {0, 0, pixel};
  return view_of(store, pixel).place;
}

void draw_layers(BeadStore& store, const std::filesystem::path& folder, double pixel) {
  if (store.layers().empty()) return;
  const View view = view_of(store, pixel);
  std::optional<picture::Image> image;
  std::optional<Pen> pen;
  std::size_t current = 0;
  const auto finish = [&] {
    if (!image) return;
    pen.reset();
    picture::write_png(folder / fmt::format("deposit-{:04}.png", current), *image);
    image.reset();
  };
  store.for_each([&](std::size_t layer, const StoredBead& bead) {
    if (!image || layer != current) {
      finish();
      current = layer;
      image.emplace(view.width, view.height, background);
      pen.emplace(*image, view.projection, Ink{});
    }
    pen->draw(bead);
  });
  finish();
}

void draw_part(BeadStore& store, const std::filesystem::path& folder) {
  if (store.layers().empty()) return;
  const CornerView view(store, margin + store.widest() / 2);
  picture::Image image(view.width, view.height, background);
  std::vector<StoredBead> beads;
  std::size_t current = 0;
  const auto draw_layer = [&] {
    if (beads.empty()) return;
    const StoredLayer& layer = store.layers()[current];
    // The walls, pixel by pixel from below, then the top.
    const double foot = layer.height * view.scale;
    for (double below = foot; below >= 1; --below) {
      Pen pen(image, view.at(layer.z - below / view.scale), below == foot ? seam : wall);
      for (const StoredBead& bead : beads) pen.draw(bead);
    }
    Pen pen(image, view.at(layer.z), top);
    for (const StoredBead& bead : beads) pen.draw(bead);
    beads.clear();
  };
  store.for_each([&](std::size_t layer, const StoredBead& bead) {
    if (layer != current) draw_layer();
    current = layer;
    beads.push_back(bead);
  });
  draw_layer();
  picture::write_png(folder / "part.png", image);
}

}  // namespace unicursal::sim
