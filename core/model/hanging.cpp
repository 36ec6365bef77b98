#include "core/model/hanging.hpp"

#include <fmt/format.h>

#include <utility>

namespace unicursal::core {
namespace {

constexpr std::size_t most_sentences = 10;
constexpr double least_contact = 0.01;  ///< mm²: less is rounding

}  // namespace

void HangingCheck::report(std::string sentence) {
  if (sentences_.size() < most_sentences) {
    sentences_.push_back(std::move(sentence));
  } else {
    ++left_out_;
  }
}

void HangingCheck::add(const Layer& layer) {
  const double underside = layer.top - layer.height;
  if (layer.islands.empty()) {
    if (begun_ && empty_++ == 0) empty_from_ = layer.index, empty_height_ = underside;
    below_.clear();
    return;
  }
  if (empty_ > 0) {
    report(fmt::format(
        "{} empty from layer {} on, at z = {:.2f} mm; what follows begins in the air at z = {:.2f} mm",
        empty_ == 1 ? "1 layer is" : fmt::format("{} layers are", empty_), empty_from_, empty_height_,
        underside));
  }
  Region outlines;
  for (const Island& island : layer.islands) {
    outlines.push_back(island.outline);
    if (!begun_ || empty_ > 0 || area(intersect({island.outline}, below_)) > least_contact) continue;
    const Vec2 place = bounds(island.outline).center();
    report(fmt::format(
        "an island of {:.3g} mm² begins in the air in layer {}, at z = {:.2f} mm near ({:.4g}, {:.4g}) mm",
        area(island.outline), layer.index, underside, place.x(), place.y()));
  }
  begun_ = true;
  empty_ = 0;
  below_ = std::move(outlines);
}

std::vector<std::string> HangingCheck::sentences() const {
  std::vector<std::string> result = sentences_;
  if (left_out_ > 0) result.push_back(fmt::format("{} more places begin in the air", left_out_));
  return result;
}

}  // namespace unicursal::core
