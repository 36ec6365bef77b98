#include "host/report/worst_places.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/picture_place.hpp"

namespace unicursal::host {
namespace {

constexpr double cell_side = 1;        // mm; a window is two cells wide and high
constexpr double hardly_amiss = 0.02;  // mm²
constexpr double same_place = 4;       // mm between places that count as one

const char* word(WorstPlace::Kind kind) {
  switch (kind) {
    case WorstPlace::Kind::gap:
      return "gap";
    case WorstPlace::Kind::overfill:
      return "overfill";
    case WorstPlace::Kind::mixture:
      return "mixture";
  }
  return "";
}

}  // namespace

AmissCells::AmissCells(const PixelGrid& grid)
    : grid_(grid),
      side_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(cell_side / grid.pixel)))),
      columns_((grid.columns + side_ - 1) / side_),
      rows_((grid.rows + side_ - 1) / side_),
      areas_(columns_ * rows_) {}

void AmissCells::add(std::size_t pixel, double area) {
  areas_[pixel / grid_.columns / side_ * columns_ + pixel % grid_.columns / side_] += area;
}

std::optional<AmissCells::Window> AmissCells::worst() const {
  double most = hardly_amiss;
  std::optional<std::size_t> found;
  for (std::size_t r = 0; r < rows_; ++r) {
    for (std::size_t c = 0; c < columns_; ++c) {
      const std::size_t here = r * columns_ + c;
      double sum = 0;
      for (const std::size_t row : {here, here + columns_}) {
        if (row < areas_.size()) sum += areas_[row];
        if (row + 1 < areas_.size() && c + 1 < columns_) sum += areas_[row + 1];
      }
      if (sum > most) most = sum, found = here;
    }
  }
  if (!found) return std::nullopt;
  const core::Vec2 corner(static_cast<double>(*found % columns_ + 1),
                          static_cast<double>(*found / columns_ + 1));
  return Window{grid_.origin + corner * (static_cast<double>(side_) * grid_.pixel), most};
}

std::vector<WorstPlace> choose_worst(std::vector<WorstPlace> places, std::size_t count) {
  std::stable_sort(places.begin(), places.end(),
                   [](const WorstPlace& a, const WorstPlace& b) { return a.area > b.area; });
  std::vector<WorstPlace> chosen;
  for (const WorstPlace& place : places) {
    if (chosen.size() == count) break;
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const WorstPlace& other) {
      return other.kind == place.kind && (other.at - place.at).norm() < same_place;
    });
    if (!known) chosen.push_back(place);
  }
  return chosen;
}

nlohmann::json to_json(const WorstPlace& place) {
  return {{"kind", word(place.kind)},
          {"layer", place.layer},
          {"x_mm", place.at.x()},
          {"y_mm", place.at.y()},
          {"area_mm2", place.area}};
}

nlohmann::json to_json(const PicturePlace& place) {
  return {place.corner.x(), place.corner.y(), place.pixel};
}

}  // namespace unicursal::host
