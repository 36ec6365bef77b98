#include "host/report/scan.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

namespace unicursal::host {
namespace {

constexpr float far_away = std::numeric_limits<float>::infinity();

void collect_crossings(const core::Ring& ring, double y, std::vector<double>& crossings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const core::Vec2 &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

/// The rows whose middle lies between two heights.
std::pair<std::size_t, std::size_t> rows_between(const PixelGrid& grid, double low, double high) {
  const auto row = [&grid](double y) {
    const double index = std::ceil((y - grid.origin.y()) / grid.pixel - 0.5);
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(grid.rows)));
  };
  return {row(low), row(high)};
}

void scan_row(const core::Polygon& polygon, const PixelGrid& grid, std::size_t row, RegionLabel label,
              std::vector<double>& crossings, std::vector<RegionLabel>& labels) {
  crossings.clear();
  const double y = grid.origin.y() + (static_cast<double>(row) + 0.5) * grid.pixel;
  collect_crossings(polygon.outer, y, crossings);
  for (const core::Ring& hole : polygon.holes) collect_crossings(hole, y, crossings);
  std::sort(crossings.begin(), crossings.end());
  const auto column = [&grid](double x) {
    const double index = std::ceil((x - grid.origin.x()) / grid.pixel - 0.5);
    return static_cast<std::ptrdiff_t>(std::clamp(index, 0.0, static_cast<double>(grid.columns)));
  };
  const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(row * grid.columns);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    std::fill(begin + column(crossings[i]), begin + column(crossings[i + 1]), label);
  }
}

/// Squared distances along a line to the lower envelope of parabolas (Felzenszwalb and Huttenlocher): for
/// every i the least of values[j] + (i − j)².
class Envelope {
 public:
  void transform(std::vector<float>& values) {
    const std::size_t n = values.size();
    places_.resize(n);
    from_.resize(n + 1);
    source_ = values;
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (source_[i] == far_away) continue;
      double begin = -std::numeric_limits<double>::infinity();
      while (count > 0 && (begin = meeting(places_[count - 1], i)) <= from_[count - 1]) --count;
      if (count == 0) begin = -std::numeric_limits<double>::infinity();
      places_[count] = i;
      from_[count++] = begin;
    }
    if (count == 0) return;
    for (std::size_t i = 0, k = 0; i < n; ++i) {
      while (k + 1 < count && from_[k + 1] < static_cast<double>(i)) ++k;
      const double d = static_cast<double>(i) - static_cast<double>(places_[k]);
      values[i] = static_cast<float>(d * d + source_[places_[k]]);
    }
  }

 private:
  double meeting(std::size_t a, std::size_t b) const {
    const double x = static_cast<double>(a), y = static_cast<double>(b);
    return (source_[b] + y * y - source_[a] - x * x) / (2 * (y - x));
  }

  std::vector<std::size_t> places_;
  std::vector<double> from_;
  std::vector<float> source_;
};

/// Works in place, first along the columns, then along the rows.
void distance_transform(std::vector<float>& squares, const PixelGrid& grid) {
  Envelope envelope;
  std::vector<float> line(grid.rows);
  for (std::size_t x = 0; x < grid.columns; ++x) {
    for (std::size_t y = 0; y < grid.rows; ++y) line[y] = squares[y * grid.columns + x];
    envelope.transform(line);
    for (std::size_t y = 0; y < grid.rows; ++y) squares[y * grid.columns + x] = line[y];
  }
  line.resize(grid.columns);
  for (std::size_t y = 0; y < grid.rows; ++y) {
    const auto row = squares.begin() + static_cast<std::ptrdiff_t>(y * grid.columns);
    std::copy_n(row, grid.columns, line.begin());
    envelope.transform(line);
    std::copy(line.begin(), line.end(), row);
  }
}

}  // namespace

std::vector<RegionLabel> scan(const std::vector<LabelledPolygon>& polygons, const PixelGrid& grid) {
  std::vector<RegionLabel> labels(grid.size(), outside_all);
  std::vector<double> crossings;
  for (const auto& [polygon, label] : polygons) {
    const core::Box box = core::bounds(polygon);
    const auto [first, end] = rows_between(grid, box.min.y(), box.max.y());
    for (std::size_t row = first; row < end; ++row) scan_row(polygon, grid, row, label, crossings, labels);
  }
  return labels;
}

std::vector<float> distance_to_other_label(const std::vector<RegionLabel>& labels, const PixelGrid& grid) {
  std::bitset<outside_all> present;
  for (const RegionLabel label : labels) {
    if (label != outside_all) present.set(label);
  }
  std::vector<float> result(labels.size(), present.count() > 1 ? 0 : far_away);
  for (RegionLabel own = 0; present.count() > 1 && own < outside_all; ++own) {
    if (!present[own]) continue;
    std::vector<float> squares(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      squares[i] = labels[i] != own && labels[i] != outside_all ? 0 : far_away;
    }
    distance_transform(squares, grid);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == own) result[i] = static_cast<float>((std::sqrt(squares[i]) - 0.5F) * grid.pixel);
    }
  }
  return result;
}

}  // namespace unicursal::host
