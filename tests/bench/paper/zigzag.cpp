#include "tests/bench/paper/zigzag.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/geometry/border_index.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;
using core::Vec2;

constexpr double inset_tolerance = 0.01;  ///< bead widths
constexpr double longest_turn = 2.5;      ///< bead widths between the ends of rows that are joined

/// A piece of a row, from left to right.
struct Span {
  double y = 0, left = 0, right = 0;
  bool used = false;
};
using Rows = std::vector<std::vector<Span>>;

/// Cuts the region with one horizontal line; even-odd.
std::vector<Span> spans_at(const core::Region& region, double y) {
  std::vector<double> cuts;
  for (const Polygon& polygon : region) {
    std::vector<const core::Ring*> rings{&polygon.outer};
    for (const core::Ring& hole : polygon.holes) rings.push_back(&hole);
    for (const core::Ring* ring : rings) {
      for (std::size_t i = 0; i < ring->size(); ++i) {
        const Vec2 &a = (*ring)[i], &b = (*ring)[(i + 1) % ring->size()];
        if ((a.y() > y) == (b.y() > y)) continue;
        cuts.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Span> spans;
  for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) spans.push_back({y, cuts[k], cuts[k + 1]});
  return spans;
}

/// Rows in the region in which a bead's middle may run, the first and the last on its border.
Rows rows_of(const core::Region& inner, double bead_width) {
  const core::Box box = core::bounds(inner);
  const double height = box.size().y(), edge = 1e-4 * bead_width;
  const auto steps = std::max(1.0, std::round(height / bead_width));
  Rows rows;
  for (double k = 0; k <= steps; ++k) {
    const double y = std::clamp(box.min.y() + height * k / steps, box.min.y() + edge, box.max.y() - edge);
    rows.push_back(spans_at(inner, y));
  }
  return rows;
}

class Joiner {
 public:
  Joiner(Rows rows, const core::Region& inner, double bead_width) : rows_(std::move(rows)), w_(bead_width) {
    for (const Polygon& polygon : inner) borders_.emplace_back(polygon, bead_width);
  }

  std::vector<Line> lines() {
    std::vector<Line> lines;
    Vec2 at = rows_.front().empty() ? Vec2(0, 0) : Vec2(rows_.front().front().left, rows_.front().front().y);
    while (const std::optional<Start> start = nearest(at)) {
      lines.push_back(follow(*start));
      at = lines.back().points.back();
    }
    return lines;
  }

 private:
  struct Start {
    std::size_t row = 0, span = 0;
    bool from_left = true;
  };

  std::optional<Start> nearest(const Vec2& at) const {
    std::optional<Start> best;
    double best_distance = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      for (std::size_t s = 0; s < rows_[r].size(); ++s) {
        const Span& span = rows_[r][s];
        if (span.used) continue;
        for (const bool left : {true, false}) {
          const double distance = (Vec2(left ? span.left : span.right, span.y) - at).norm();
          if (best && distance >= best_distance) continue;
          best = Start{r, s, left};
          best_distance = distance;
        }
      }
    }
    return best;
  }

  /// Goes from row to row as long as the next one begins where this one ends.
  Line follow(Start at) {
    Line line;
    line.closed = false;
    for (std::optional<Start> next = at; next;) {
      Span& span = rows_[next->row][next->span];
      span.used = true;
      const double from = next->from_left ? span.left : span.right,
                   to = next->from_left ? span.right : span.left;
      line.points.emplace_back(from, span.y);
      line.points.emplace_back(to, span.y);
      next = beside(*next, {to, span.y});
    }
    return line;
  }

  std::optional<Start> beside(const Start& at, const Vec2& end) const {
    std::optional<Start> best;
    double best_distance = longest_turn * w_;
    for (const std::size_t row : {at.row + 1, at.row - 1}) {  // wraps around below the first row
      if (row >= rows_.size()) continue;
      for (std::size_t s = 0; s < rows_[row].size(); ++s) {
        const Span& span = rows_[row][s];
        // A zigzag turns: it goes back on the side on which it came.
        const Vec2 begin(at.from_left ? span.right : span.left, span.y);
        const double distance = (begin - end).norm();
        if (span.used || distance >= best_distance || !inside(end, begin)) continue;
        best = Start{row, s, !at.from_left};
        best_distance = distance;
      }
    }
    return best;
  }

  /// Whether the whole turn stays where a bead's middle may run, except for a tenth of a width.
  bool inside(const Vec2& a, const Vec2& b) const {
    for (double t = 0.05; t < 1; t += 0.1) {
      const Vec2 p = a + t * (b - a);
      const bool in = std::any_of(borders_.begin(), borders_.end(), [&](const core::BorderIndex& border) {
        return border.contains(p) || border.distance(p, p, w_) < 0.1 * w_;
      });
      if (!in) return false;
    }
    return true;
  }

  Rows rows_;
  double w_;
  std::vector<core::BorderIndex> borders_;
};

core::Ring turned(const core::Ring& ring, double cosine, double sine) {
  core::Ring result;
  for (const Vec2& p : ring)
    result.emplace_back(cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y());
  return result;
}

std::vector<Line> zigzag_along(const Polygon& island, double bead_width, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  Polygon flat{turned(island.outer, cosine, -sine), {}};
  for (const core::Ring& hole : island.holes) flat.holes.push_back(turned(hole, cosine, -sine));
  const core::Region inner = core::offset({flat}, -bead_width / 2, inset_tolerance * bead_width);
  if (inner.empty()) return {};
  std::vector<Line> lines = Joiner(rows_of(inner, bead_width), inner, bead_width).lines();
  for (Line& line : lines) line.points = turned(line.points, cosine, sine);
  return lines;
}

}  // namespace

Filling zigzag(const Polygon& island, double bead_width, int directions) {
  Filling best;
  for (int k = 0; k < directions; ++k) {
    std::vector<Line> lines = zigzag_along(island, bead_width, std::numbers::pi * k / directions);
    if (best.lines.empty() || (!lines.empty() && lines.size() < best.lines.size()))
      best.lines = std::move(lines);
  }
  return best;
}

}  // namespace unicursal::bench
