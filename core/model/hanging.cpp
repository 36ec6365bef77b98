#include "core/model/hanging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace unicursal::core {
namespace {

constexpr std::size_t most_places = 1000, most_sentences = 10;
constexpr double least_island = 0.25;     ///< of the square of a bead width: less cannot be printed anyway
constexpr double least_contact = 0.01;    ///< mm²: less is rounding
constexpr double supported_share = 0.5;   ///< of a bead's width
constexpr double least_overhang = 1;      ///< of the square of a bead width: less is a corner
constexpr double tolerance_share = 0.05;  ///< of a bead width, when outlines grow

double underside(const Layer& layer) {
  return layer.top - layer.height;
}

std::string sentence_of(const HangingPlace& place) {
  const std::string where =
      fmt::format("z = {:.2f} mm near ({:.4g}, {:.4g}) mm", place.z, place.place.x(), place.place.y());
  switch (place.kind) {
    case HangingPlace::Kind::island:
      return fmt::format("an island of {:.3g} mm² begins in the air in layer {}, at {}", place.area,
                         place.layer, where);
    case HangingPlace::Kind::empty_layers:
      return fmt::format("{} empty from layer {} on, at z = {:.2f} mm; what follows begins in the air",
                         place.layers == 1 ? "1 layer is" : fmt::format("{} layers are", place.layers),
                         place.layer, place.z);
    case HangingPlace::Kind::overhang:
      break;
  }
  return fmt::format("{:.3g} mm² of layer {} hang over, at {}", place.area, place.layer, where);
}

}  // namespace

const char* word(HangingPlace::Kind kind) {
  switch (kind) {
    case HangingPlace::Kind::island:
      return "island";
    case HangingPlace::Kind::empty_layers:
      return "empty layers";
    case HangingPlace::Kind::overhang:
      break;
  }
  return "overhang";
}

void HangingCheck::keep(const HangingPlace& place) {
  if (places_.size() < most_places) {
    places_.push_back(place);
  } else {
    ++left_out_;
  }
}

void HangingCheck::look_for_overhang(const Layer& layer, const Region& resting) {
  const Region free =
      subtract(resting, offset(below_, supported_share * bead_width_, tolerance_share * bead_width_));
  HangingPlace place{HangingPlace::Kind::overhang, layer.index, 1, underside(layer), {0, 0}, 0};
  double largest = 0;
  for (const Polygon& piece : free) {
    const double size = area(piece);
    if (size < least_overhang * bead_width_ * bead_width_) continue;
    place.area += size;
    if (size > largest) largest = size, place.place = bounds(piece).center();
  }
  if (place.area == 0) {
    overhung_ = false;
    return;
  }
  if (overhung_ && overhang_ < places_.size()) {
    HangingPlace& run = places_[overhang_];
    const std::size_t layers = run.layers + 1;
    if (place.area > run.area) run = place;
    run.layers = layers;
    return;
  }
  overhung_ = true;
  overhang_ = places_.size();
  keep(place);
}

void HangingCheck::add(const Layer& layer) {
  if (rests_on_bed(layer)) begin_part();
  if (layer.islands.empty()) {
    if (begun_ && empty_.layers++ == 0) empty_.layer = layer.index, empty_.z = underside(layer);
    below_.clear();
    overhung_ = false;
    return;
  }
  if (begun_ && empty_.layers > 0) keep(empty_);
  Region outlines, resting;
  for (const Island& island : layer.islands) {
    outlines.push_back(island.outline);
    if (!begun_) continue;
    if (area(island.outline) < least_island * bead_width_ * bead_width_) continue;
    if (area(intersect({island.outline}, below_)) > least_contact) {
      resting.push_back(island.outline);
    } else {
      keep({HangingPlace::Kind::island, layer.index, 1, underside(layer), bounds(island.outline).center(),
            area(island.outline)});
    }
  }
  if (!resting.empty()) {
    look_for_overhang(layer, resting);
  } else {
    overhung_ = false;
  }
  begun_ = true;
  empty_ = {HangingPlace::Kind::empty_layers, 0, 0, 0, {0, 0}, 0};
  below_ = std::move(outlines);
}

void HangingCheck::begin_part() {
  begun_ = overhung_ = false;
  below_.clear();
  empty_ = {HangingPlace::Kind::empty_layers, 0, 0, 0, {0, 0}, 0};
}

std::vector<std::string> HangingCheck::sentences() const {
  std::vector<std::string> result;
  std::size_t left_out = left_out_, overhangs = 0;
  const HangingPlace* worst = nullptr;
  for (const HangingPlace& place : places_) {
    if (place.kind == HangingPlace::Kind::overhang) {
      overhangs += place.layers;
      if (!worst || place.area > worst->area) worst = &place;
    } else if (result.size() < most_sentences) {
      result.push_back(sentence_of(place));
    } else {
      ++left_out;
    }
  }
  if (left_out > 0) result.push_back(fmt::format("{} more places begin in the air", left_out));
  if (worst) {
    result.push_back(overhangs == 1
                         ? sentence_of(*worst)
                         : fmt::format("{} layers hang over; the worst: {}", overhangs, sentence_of(*worst)));
  }
  return result;
}

}  // namespace unicursal::core
