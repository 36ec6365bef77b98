#include "host/report/deposit_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware_gcode/mixing/chamber.hpp"
#include "host/report/deposit_pictures.hpp"

namespace unicursal::host {
namespace {

using gcode::Shares;

constexpr double margin = 1;     // mm around the part that count as beside it
constexpr double widest = 1.5;   // stroke widths that its plastic may spread over
constexpr double hardly = 0.05;  // fill below which no mixture has arrived
constexpr double amiss = 0.1;    // fraction of misplaced plastic above which a gradient's shade is wrong

/// The raster's pixels on and around the part.
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

/// Sorts plastic beyond the part's rim into prime line, skirt and the rest.
class Outside {
 public:
  Outside(const TargetLayer& target, const sim::RasterFrame& frame)
      : target_(target), volume_(frame.pixel * frame.pixel * frame.height), pixel_(frame.pixel) {}

  /// Adds a pixel beyond the rim.
  void beyond(const core::Vec2& place, double fill) {
    if (fill <= 0) return;
    double& of = lies_on(target_.prime, place) ? prime : lies_on(target_.skirt, place) ? skirt : elsewhere;
    of += fill * volume_;
  }

  double prime = 0, skirt = 0, elsewhere = 0;  ///< mm³

 private:
  bool lies_on(const std::vector<Stroke>& strokes, const core::Vec2& place) const {
    return std::any_of(strokes.begin(), strokes.end(), [&](const Stroke& stroke) {
      return core::distance_to_segment(place, stroke.from, stroke.to) <= widest * stroke.width / 2 + pixel_;
    });
  }

  const TargetLayer& target_;
  double volume_;  ///< mm³ of a full pixel
  double pixel_;
};

/// The part's rim on the grid: pixels within `width` of the part, by distance.
class Rim {
 public:
  Rim(const std::vector<RegionLabel>& labels, const PixelGrid& grid, double width)
      : labels_(labels), grid_(grid) {
    const double reach = width / grid.pixel + 0.5;  // to the border of the last pixel within
    const auto whole = static_cast<long>(reach);
    for (long dy = -whole; dy <= whole; ++dy) {
      for (long dx = -whole; dx <= whole; ++dx) {
        if (static_cast<double>(dx * dx + dy * dy) <= reach * reach) steps_.push_back({dx, dy});
      }
    }
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
      return a.dx * a.dx + a.dy * a.dy < b.dx * b.dx + b.dy * b.dy;
    });
  }

  bool holds(std::size_t index) const {
    const auto x = static_cast<long>(index % grid_.columns), y = static_cast<long>(index / grid_.columns);
    return std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
      const long cx = x + step.dx, cy = y + step.dy;
      if (cx < 0 || cy < 0 || cx >= static_cast<long>(grid_.columns) || cy >= static_cast<long>(grid_.rows))
        return false;
      const std::size_t at = static_cast<std::size_t>(cy) * grid_.columns + static_cast<std::size_t>(cx);
      return labels_[at] != outside_all;
    });
  }

 private:
  struct Step {
    long dx, dy;
  };

  const std::vector<RegionLabel>& labels_;
  const PixelGrid& grid_;
  std::vector<Step> steps_;
};

/// The raster, cut or padded to the grid.
std::vector<sim::RasterPixel> read(const sim::RasterFrame& frame, const RowSource& rows,
                                   const PixelGrid& grid, Outside& outside) {
  const auto shift = [&](double from, double to) { return std::llround((to - from) / grid.pixel); };
  const auto left = shift(grid.origin.x(), frame.left), bottom = shift(grid.origin.y(), frame.bottom);
  const auto place = [&](std::uint64_t column, std::uint64_t at_row) {
    const core::Vec2 steps(static_cast<double>(column) + 0.5, static_cast<double>(at_row) + 0.5);
    return core::Vec2(core::Vec2(frame.left, frame.bottom) + steps * frame.pixel);
  };
  std::vector<sim::RasterPixel> pixels(grid.size()), row(frame.columns);
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    rows(row);
    const auto y = static_cast<long long>(r) + bottom;
    if (y < 0 || y >= static_cast<long long>(grid.rows)) {
      for (std::uint64_t c = 0; c < frame.columns; ++c) outside.beyond(place(c, r), row[c].fill);
      continue;
    }
    for (std::uint64_t c = 0; c < frame.columns; ++c) {
      const auto x = static_cast<long long>(c) + left;
      if (x < 0 || x >= static_cast<long long>(grid.columns)) {
        outside.beyond(place(c, r), row[c].fill);
        continue;
      }
      pixels[static_cast<std::size_t>(y) * grid.columns + static_cast<std::size_t>(x)] = row[c];
    }
  }
  return pixels;
}

Shares shares_of(const sim::RasterPixel& pixel, std::size_t feeders) {
  Shares shares = Shares::zeros(feeders);
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] = pixel.share(f);
  return shares;
}

/// The materials of this layer alone: a place cannot belong to a zone of another layer.
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
        by_beads_(target.by_beads),
        middle_(target.top - target.height / 2),
        materials_(materials_of(target)),
        grid_(grid),
        labels_(scan(target.zones, grid)),
        missing_(grid),
        heaped_(grid),
        mixed_up_(grid),
        rim_(labels_, grid, std::min(target.bead_width / 2, margin)) {}

  DepositFindings findings(const std::vector<sim::RasterPixel>& pixels, Outside& outside) {
    wrong_.assign(pixels.size(), false);
    const double place = grid_.pixel * grid_.pixel;
    const std::size_t feeders = intended_.empty() ? 0 : intended_.front().mixture.feeders();
    DepositFindings f;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double fill = pixels[i].fill;
      if (labels_[i] == outside_all) {
        f.spilled += fill * place;
        if (fill > 0 && !rim_.holds(i)) outside.beyond(grid_.middle(i), fill);
        continue;
      }
      f.area += place;
      const double missing = std::max(0.0, 1 - fill) * place, heaped = std::max(0.0, fill - 1) * place;
      f.gaps += missing;
      f.overfill += heaped;
      missing_.add(i, missing);
      heaped_.add(i, heaped);
      f.fill.add(fill, place);
      f.fill_moment += fill * place;
      f.fill_squares += fill * fill * place;
      if (fill >= hardly) judge_mixture(i, shares_of(pixels[i], feeders), f);
    }
    measure_distances(f);
    f.outside = outside.elsewhere, f.prime = outside.prime, f.skirt = outside.skirt;
    return f;
  }

  const std::vector<RegionLabel>& labels() const { return labels_; }
  const std::vector<bool>& wrong() const { return wrong_; }
  std::vector<WorstPlace> worst(std::size_t layer) const {
    std::vector<WorstPlace> places;
    const auto add = [&](WorstPlace::Kind kind, const AmissCells& cells) {
      if (const auto window = cells.worst()) places.push_back({kind, layer, window->at, window->area});
    };
    add(WorstPlace::Kind::gap, missing_);
    add(WorstPlace::Kind::overfill, heaped_);
    add(WorstPlace::Kind::mixture, mixed_up_);
    return places;
  }

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
    const double distance = gcode::squared_distance(arrived, own);
    wrong_[i] =
        material.gradient
            ? error > amiss
            : std::any_of(materials_.begin(), materials_.end(), [&](RegionLabel other) {
                const IntendedMaterial& rival = intended_.at(other);
                return !rival.gradient && gcode::squared_distance(arrived, rival.mixture.shares()) < distance;
              });
    if (!wrong_[i]) return;
    f.wrong += place;
    mixed_up_.add(i, place);
  }

  void measure_distances(DepositFindings& f) const {
    if (f.wrong == 0 || by_beads_) return;
    const std::vector<float> distances = distance_to_other_label(labels_, grid_);
    for (std::size_t i = 0; i < wrong_.size(); ++i) {
      if (wrong_[i]) f.wrong_distance.add(distances[i], grid_.pixel * grid_.pixel);
    }
  }

  const std::vector<IntendedMaterial>& intended_;
  bool by_beads_;
  double middle_;  ///< height of the layer's middle
  std::vector<RegionLabel> materials_;
  const PixelGrid& grid_;
  std::vector<RegionLabel> labels_;
  AmissCells missing_, heaped_, mixed_up_;
  Rim rim_;
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
                  const std::vector<IntendedMaterial>& materials, bool draw,
                  const picture::Filaments& filaments) {
  const PixelGrid grid = grid_around(target, frame);
  Outside outside(target, frame);
  const std::vector<sim::RasterPixel> pixels = read(frame, rows, grid, outside);
  Judge judge(target, materials, grid);
  JudgedLayer result;
  result.findings = judge.findings(pixels, outside);
  result.worst = judge.worst(target.index);
  if (draw) {
    const DepositView view{grid, judge.labels(), pixels, judge.wrong(), filaments};
    result.gaps = draw_gaps(view);
    result.mixtures = draw_mixtures(view);
    result.place = place_of(grid);
  }
  return result;
}

}  // namespace unicursal::host
