#include "host/report/deposit_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware_gcode/mixing/response.hpp"
#include "host/report/deposit_pictures.hpp"

namespace unicursal::host {
namespace {

using Shares = std::array<double, gcode::max_feeders>;

constexpr double margin = 1;     // mm around the part that counts as beside it
constexpr double hardly = 0.05;  // fill below which no mixture has arrived
constexpr double amiss = 0.1;    // of the plastic, misplaced: a gradient's shade is wrong

/// The raster's own pixels, as far as they lie around the part.
PixelGrid grid_around(const TargetLayer& target, const sim::RasterFrame& frame) {
  core::Box box = core::bounds(target.zones.front().polygon);
  for (const auto& [polygon, label] : target.zones) {
    const core::Box more = core::bounds(polygon);
    box.min = box.min.cwiseMin(more.min);
    box.max = box.max.cwiseMax(more.max);
  }
  const core::Vec2 corner{frame.left, frame.bottom};
  const core::Vec2 first = ((box.min - corner).array() - margin).matrix() / frame.pixel;
  const core::Vec2 count = ((box.max - box.min).array() + 2 * margin).matrix() / frame.pixel;
  const core::Vec2 whole = first.array().floor().matrix();
  return {corner + whole * frame.pixel, frame.pixel, static_cast<std::size_t>(std::ceil(count.x())) + 1,
          static_cast<std::size_t>(std::ceil(count.y())) + 1};
}

/// The raster cut or padded to the grid.
std::vector<sim::RasterPixel> read(const sim::RasterFrame& frame, const RowSource& rows,
                                   const PixelGrid& grid) {
  const auto shift = [&](double from, double to) { return std::llround((to - from) / grid.pixel); };
  const auto left = shift(grid.origin.x(), frame.left), bottom = shift(grid.origin.y(), frame.bottom);
  std::vector<sim::RasterPixel> pixels(grid.size()), row(frame.columns);
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    rows(row);
    const auto y = static_cast<long long>(r) + bottom;
    if (y < 0 || y >= static_cast<long long>(grid.rows)) continue;
    for (std::uint64_t c = 0; c < frame.columns; ++c) {
      const auto x = static_cast<long long>(c) + left;
      if (x < 0 || x >= static_cast<long long>(grid.columns)) continue;
      pixels[static_cast<std::size_t>(y) * grid.columns + static_cast<std::size_t>(x)] = row[c];
    }
  }
  return pixels;
}

Shares shares_of(const sim::RasterPixel& pixel) {
  Shares shares{};
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] = pixel.share(f);
  return shares;
}

double squared_difference(const Shares& a, const Shares& b) {
  double sum = 0;
  for (std::size_t f = 0; f < a.size(); ++f) sum += (a[f] - b[f]) * (a[f] - b[f]);
  return sum;
}

/// The materials of this layer alone: what another layer is made of is no zone that this place could belong
/// to.
std::vector<RegionLabel> materials_of(const TargetLayer& target) {
  std::vector<RegionLabel> materials;
  for (const auto& [polygon, label] : target.zones) materials.push_back(label);
  std::sort(materials.begin(), materials.end());
  materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
  return materials;
}

class Judge {
 public:
  Judge(const TargetLayer& target, const std::vector<IntendedMaterial>& materials, const PixelGrid& grid)
      : intended_(materials),
        middle_(target.top - target.height / 2),
        materials_(materials_of(target)),
        grid_(grid),
        labels_(scan(target.zones, grid)) {}

  DepositFindings findings(const std::vector<sim::RasterPixel>& pixels) {
    wrong_.assign(pixels.size(), false);
    const double place = grid_.pixel * grid_.pixel;
    DepositFindings f;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double fill = pixels[i].fill;
      if (labels_[i] == outside_all) {
        f.spilled += fill * place;
        continue;
      }
      f.area += place;
      f.gaps += std::max(0.0, 1 - fill) * place;
      f.overfill += std::max(0.0, fill - 1) * place;
      f.fill.add(fill, place);
      f.fill_moment += fill * place;
      f.fill_squares += fill * fill * place;
      if (fill >= hardly) judge_mixture(i, shares_of(pixels[i]), f);
    }
    measure_distances(f);
    return f;
  }

  const std::vector<RegionLabel>& labels() const { return labels_; }
  const std::vector<bool>& wrong() const { return wrong_; }

 private:
  void judge_mixture(std::size_t i, const Shares& arrived, DepositFindings& f) {
    const double place = grid_.pixel * grid_.pixel;
    const IntendedMaterial& material = intended_.at(labels_[i]);
    if (material.transition) {
      f.transition += place;
      return;
    }
    const Shares own = material.at(grid_.middle(i), middle_);
    const double error = gcode::misplaced(arrived, own);
    f.mixture_error += error * place;
    const double distance = squared_difference(arrived, own);
    wrong_[i] = material.gradient ? error > amiss
                                  : std::any_of(materials_.begin(), materials_.end(), [&](RegionLabel other) {
                                      const IntendedMaterial& rival = intended_.at(other);
                                      return !rival.gradient &&
                                             squared_difference(arrived, rival.mixture.shares()) < distance;
                                    });
    if (wrong_[i]) f.wrong += place;
  }

  void measure_distances(DepositFindings& f) const {
    if (f.wrong == 0) return;
    const std::vector<float> distances = distance_to_other_label(labels_, grid_);
    for (std::size_t i = 0; i < wrong_.size(); ++i) {
      if (wrong_[i]) f.wrong_distance.add(distances[i], grid_.pixel * grid_.pixel);
    }
  }

  const std::vector<IntendedMaterial>& intended_;
  double middle_;  ///< height of the layer's middle
  std::vector<RegionLabel> materials_;
  const PixelGrid& grid_;
  std::vector<RegionLabel> labels_;
  std::vector<bool> wrong_;
};

}  // namespace

Shares IntendedMaterial::at(const core::Vec2& place, double z) const {
  Shares shares = mixture.shares();
  if (!gradient) return shares;
  const double part = gradient->part_at(place, z);
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] += part * (gradient->to.share(f) - shares[f]);
  return shares;
}

JudgedLayer judge(const TargetLayer& target, const sim::RasterFrame& frame, const RowSource& rows,
                  const std::vector<IntendedMaterial>& materials, bool draw) {
  const PixelGrid grid = grid_around(target, frame);
  const std::vector<sim::RasterPixel> pixels = read(frame, rows, grid);
  Judge judge(target, materials, grid);
  JudgedLayer result;
  result.findings = judge.findings(pixels);
  if (draw) {
    const DepositView view{grid, judge.labels(), pixels, judge.wrong()};
    result.gaps = draw_gaps(view);
    result.mixtures = draw_mixtures(view);
  }
  return result;
}

}  // namespace unicursal::host
