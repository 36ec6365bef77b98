// The places of a dry run that a person should look at first: where most plastic is missing, stands too high
// or has another zone's mixture. A place is a window of 2 × 2 mm. mm, mm².
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/numeric/vec2.hpp"
#include "host/report/scan.hpp"

namespace unicursal::host {

struct WorstPlace {
  enum class Kind { gap, overfill, mixture };

  Kind kind = Kind::gap;
  std::size_t layer = 0;
  core::Vec2 at{0, 0};  ///< the window's middle, on the bed
  double area = 0;      ///< what is amiss in it
};

/// Sums what is amiss in a layer, pixel by pixel, into cells of the grid.
class AmissCells {
 public:
  explicit AmissCells(const PixelGrid& grid);

  /// `area`: mm² that are amiss in the pixel.
  void add(std::size_t pixel, double area);
  /// The middle of the window that holds most, and how much; absent if that is hardly anything.
  struct Window {
    core::Vec2 at{0, 0};
    double area = 0;
  };
  std::optional<Window> worst() const;

 private:
  const PixelGrid& grid_;
  std::size_t side_;  ///< of a cell, pixels
  std::size_t columns_, rows_;
  std::vector<double> areas_;
};

/// At most `count` of them, the worst first. Of places of one kind above each other only the worst is chosen.
std::vector<WorstPlace> choose_worst(std::vector<WorstPlace> places, std::size_t count);

/// `kind`, `layer`, `x_mm`, `y_mm`, `area_mm2`.
nlohmann::json to_json(const WorstPlace& place);

}  // namespace unicursal::host
