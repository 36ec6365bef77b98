#include "host/tune/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "host/tune/digits.hpp"
#include "host/tune/strip_sizes.hpp"

namespace unicursal::host {
namespace {

constexpr double side = 10;           ///< mm, of a patch
constexpr double border = 1.5;        ///< mm of a patch that are not looked at
constexpr double purge_factor = 1.5;  ///< of dead and mixing volume
constexpr double least_purge = 2;     ///< mm of a band between two patches
constexpr double chart_flow = 3;      ///< mm³/s

using Parts = std::vector<double>;

Parts alone(std::size_t feeders, std::size_t feeder) {
  Parts parts(feeders);
  parts[feeder] = 1;
  return parts;
}

void add_pair(std::vector<Parts>& all, std::size_t feeders, std::size_t a, std::size_t b, double step) {
  Parts parts(feeders);
  parts[a] = 1 - step;
  parts[b] = step;
  all.push_back(std::move(parts));
}

/// As many as there is room for: with many feeders only some of the pairs, each feeder in as many as the
/// others.
void add_pairs(std::vector<Parts>& all, std::size_t feeders) {
  const std::size_t room = most_patches - 2 * feeders, pairs = feeders * (feeders - 1) / 2;
  const std::vector<double> steps = feeders == 2   ? Parts{0.06, 0.15, 0.3, 0.5, 0.7, 0.85, 0.94}
                                    : feeders == 3 ? Parts{0.2, 0.5, 0.8}
                                    : feeders == 4 ? Parts{0.25, 0.75}
                                                   : Parts{0.5};
  // Neighbours in a ring first; those that lie opposite are half as many.
  std::vector<std::size_t> distances;
  for (std::size_t distance = 1; distance <= feeders / 2; ++distance) distances.push_back(distance);
  if (pairs > room && feeders % 2 == 0) distances = {1, feeders / 2};
  std::size_t left = pairs > room ? room : pairs;
  for (const std::size_t distance : distances) {
    const std::size_t count = 2 * distance == feeders ? feeders / 2 : feeders;
    if (count > left) break;
    left -= count;
    for (std::size_t a = 0; a < count; ++a) {
      for (const double step : steps) add_pair(all, feeders, a, (a + distance) % feeders, step);
    }
  }
}

void add_triples(std::vector<Parts>& all, std::size_t feeders) {
  if (feeders == 3) {
    all.insert(all.end(), {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 3}});
  } else if (feeders == 4 || feeders == 5) {
    for (std::size_t a = 0; a < feeders; ++a) {
      Parts parts(feeders);
      for (std::size_t i = 0; i < 3; ++i) parts[(a + i) % feeders] = 1;
      all.push_back(std::move(parts));
    }
  }
}

/// In the order of printing: the feeders alone at even distances, 1, 2, 3 … and again from 1, among the
/// others.
std::vector<Parts> recipes(std::size_t feeders) {
  std::vector<Parts> mixed;
  add_pairs(mixed, feeders);
  add_triples(mixed, feeders);
  std::vector<Parts> all(mixed.size() + 2 * feeders);
  for (std::size_t i = 0; i < 2 * feeders; ++i)
    all[i * (all.size() - 1) / (2 * feeders - 1)] = alone(feeders, i % feeders);
  auto next = mixed.begin();
  for (Parts& parts : all) {
    if (parts.empty()) parts = std::move(*next++);
  }
  return all;
}

class ChartLayout {
 public:
  ChartLayout(const gcode::Printer& printer, std::size_t marks, double thickness)
      : printer_(printer), s_(printer), mark_(s_.line), marks_feeder_(marks), thickness_(thickness) {
    const double purge = purge_factor * (printer.dead_volume + printer.mixing_volume);
    lanes_ = std::round(side / s_.line);
    pitch_ = side / lanes_;
    purge_lanes_ = std::ceil(std::max(purge / (side * s_.layer_height), least_purge) / pitch_);
    cell_ = purge_lanes_ * pitch_ + side;
  }

  Chart operator()() {
    const std::vector<Parts> all = recipes(printer_.feeders);
    const double around = 2 * mark_.ring_outer + 3 * s_.line;
    const double width = s_.right - s_.left - 2 * around, depth = s_.back - s_.front - 2 * around;
    const auto columns = static_cast<std::size_t>(std::max(0.0, std::floor((width - pitch_) / cell_)));
    const std::size_t rows = columns ? (all.size() + columns - 1) / columns : 0;
    const double needed = static_cast<double>(rows) * row_pitch();
    if (columns == 0 || needed > depth) refuse(all.size());
    const std::size_t even = (all.size() + rows - 1) / rows;  // rows of the same length
    const core::Vec2 size(static_cast<double>(even) * cell_ + pitch_, needed);
    const core::Vec2 corner((s_.left + s_.right - size.x()) / 2, (s_.front + s_.back - size.y()) / 2);
    const core::Vec2 margin = core::Vec2::Constant(mark_.ring_outer + 3 * s_.line);
    chart_.marks = mark_places({corner - margin, corner + size + margin});
    lay_patches(all, corner + core::Vec2(0, below()), even);
    describe();
    return std::move(chart_);
  }

 private:
  /// Room for a number in front of its patch, and a gap on both sides of it.
  double below() const { return s_.digit_height + 4 * s_.line; }
  double row_pitch() const { return side + below(); }

  [[noreturn]] void refuse(std::size_t patches) const {
    throw core::DataError(
        "", "printer.bed",
        fmt::format("is too small for a chart of {} patches with {:g} mm³ of plastic before each of them",
                    patches, purge_factor * (printer_.dead_volume + printer_.mixing_volume)),
        "check transition.dead_volume and transition.mixing_volume of the profile, or its bed");
  }

  void lay_patches(const std::vector<Parts>& all, const core::Vec2& corner, std::size_t columns) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t row = i / columns, column = i % columns;
      const bool back = row % 2 == 1;
      if (column == 0) begin_row(corner, row, columns);
      add_lanes(purge_lanes_, i, back);
      const double from = here_.x();
      add_lanes(lanes_, i, back);
      add_patch(all[i], std::min(from, here_.x()), corner.y() + static_cast<double>(row) * row_pitch());
    }
  }

  /// The first lane of a row; the bead goes up to it beside the band.
  void begin_row(const core::Vec2& corner, std::size_t row, std::size_t columns) {
    const double y = corner.y() + static_cast<double>(row) * row_pitch();
    const double x = row % 2 == 0 ? corner.x() : corner.x() + static_cast<double>(columns) * cell_;
    const core::Vec2 start(x, y);
    bottom_ = y;
    if (row == 0) {
      bead_.start = start;
      here_ = start;
    } else {
      go(start, bead_.moves.back().mixture);
    }
  }

  void go(const core::Vec2& to, std::size_t mixture) {
    bead_.moves.push_back({to, (to - here_).norm() * pitch_ * s_.layer_height, mixture});
    here_ = to;
  }

  void add_lanes(double count, std::size_t mixture, bool back) {
    for (double lane = 0; lane < count; ++lane) {
      const bool up = here_.y() < bottom_ + side / 2;
      go({here_.x(), up ? bottom_ + side : bottom_}, mixture);
      go(here_ + core::Vec2(back ? -pitch_ : pitch_, 0), mixture);
    }
  }

  void add_patch(const Parts& parts, double left, double front) {
    const gcode::Dialect& dialect = gcode::dialect_named(printer_.firmware);
    const gcode::Mixture wanted = gcode::Mixture(gcode::Shares::of(parts)).with_floor(printer_.floor_share);
    ChartPatch patch{gcode::calibrated(wanted, printer_.flow_factors, dialect).delivered, {}, {}, {}};
    const auto whole = std::find(parts.begin(), parts.end(), 1.0);
    if (std::count(parts.begin(), parts.end(), 0.0) + 1 == std::ssize(parts))
      patch.feeder = static_cast<std::size_t>(whole - parts.begin());
    patch.square = {{left, front}, {left + side, front + side}};
    const core::Vec2 inwards = core::Vec2::Constant(border);
    patch.middle = {patch.square.min + inwards, patch.square.max - inwards};
    chart_.patches.push_back(patch);
  }

  void describe() {
    TestPrint& print = chart_.print;
    print.title = fmt::format("a chart of {} mixtures", chart_.patches.size());
    print.name = "the chart";
    print.layer_height = s_.layer_height;
    print.line_width = s_.line;
    print.flow = chart_flow;
    for (const ChartPatch& patch : chart_.patches) print.mixtures.push_back(patch.mixture);
    const auto alone = [&](const ChartPatch& patch) { return patch.feeder == marks_feeder_; };
    const auto marks = std::find_if(chart_.patches.begin(), chart_.patches.end(), alone);
    print.marks_mixture = static_cast<std::size_t>(marks - chart_.patches.begin());
    const double layers = std::max(1.0, std::ceil(thickness_ / s_.layer_height - 1e-9));
    print.layers.assign(static_cast<std::size_t>(layers), {{}, {}, {bead_}});
    print.layers.front().marks = marks_and_numbers();
  }

  std::vector<std::vector<core::Vec2>> marks_and_numbers() const {
    std::vector<std::vector<core::Vec2>> strokes;
    for (std::size_t i = 0; i < chart_.patches.size(); ++i) {
      const core::Box& square = chart_.patches[i].square;
      const core::Vec2 corner(square.center().x() - number_width(i + 1, s_) / 2,
                              square.min.y() - 2 * s_.line - s_.digit_height);
      for (auto& stroke : number_strokes(i + 1, corner, s_)) strokes.push_back(std::move(stroke));
    }
    // After the numbers the nozzle is full of the marks' filament.
    for (const core::Vec2& place : chart_.marks) {
      for (auto& stroke : mark_strokes(place, s_.line)) strokes.push_back(std::move(stroke));
    }
    return strokes;
  }

  const gcode::Printer& printer_;
  const StripSizes s_;
  const MarkSizes mark_;
  const std::size_t marks_feeder_;
  const double thickness_;
  double lanes_ = 0, purge_lanes_ = 0;  ///< whole numbers
  double pitch_ = 0, cell_ = 0;
  double bottom_ = 0;  ///< of the row
  core::Vec2 here_{0, 0};
  TestBead bead_;
  Chart chart_;
};

}  // namespace

Chart make_chart(const gcode::Printer& printer, std::size_t marks, double thickness) {
  return ChartLayout(printer, marks, thickness)();
}

}  // namespace unicursal::host
