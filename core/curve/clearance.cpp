#include "core/curve/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest_kernel.hpp"
#include "core/geometry/predicates.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/geometry/segment_rows.hpp"

namespace unicursal::core {
namespace {

constexpr double safe_share = 0.45;    ///< share of a clearance that either side may use; less than one half
constexpr double rounding = 1e-14;     ///< a distance that may be zero, as a share of the largest coordinate
constexpr double headroom = 1 + 1e-6;  ///< on how far is searched, for rounding
constexpr double least_margin = 1e-9;  ///< mm, for rounding
constexpr std::size_t few = 6;         ///< a curve of fewer segments is searched as a whole
constexpr std::size_t range = 1024;    ///< segments per piece of parallel work

double mean_length(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& s : segments) sum += (s.b - s.a).norm();
  return sum / static_cast<double>(segments.size());
}

bool neighbours(const Curve& curve, std::size_t i, std::size_t j) {
  return i == j || curve.after(i) == j || curve.after(j) == i;
}

/// Whether two closed segments share a point. Exact.
bool meet(const Segment& s, const Segment& t) {
  const int a = orientation(s.a, s.b, t.a), b = orientation(s.a, s.b, t.b);
  const int c = orientation(t.a, t.b, s.a), d = orientation(t.a, t.b, s.b);
  if (a * b > 0 || c * d > 0) return false;
  if (a == 0 && b == 0) {  // on one line: do their boxes overlap?
    const Vec2 low = s.a.cwiseMin(s.b).cwiseMax(t.a.cwiseMin(t.b)),
               high = s.a.cwiseMax(s.b).cwiseMin(t.a.cwiseMax(t.b));
    return (low.array() <= high.array()).all();
  }
  return true;
}

/// The squared distance from every segment of a closed curve to the nearest segment that has no vertex in
/// common with it. Since no two segments meet, it is the distance from a vertex of one to the other.
class Strands {
 public:
  Strands(const Curve& curve, const std::vector<Segment>& segments, double reach)
      : curve_(curve), segments_(segments), rows_(segments), reach_(reach) {
    const std::size_t padded = rows_.order().size() + 3;
    for (auto* array : {&ax_, &ay_, &ux_, &uy_, &inverse_}) array->resize(padded);
    for (std::size_t k = 0; k < rows_.order().size(); ++k) {
      const Segment& s = segments[static_cast<std::size_t>(rows_.order()[k])];
      const Vec2 u = s.b - s.a;
      ax_[k] = s.a.x(), ay_[k] = s.a.y();
      ux_[k] = u.x(), uy_[k] = u.y();
      inverse_[k] = inverse(u);
      half_length_ = std::max(half_length_, headroom * u.norm() / 2);
    }
    from_start_.assign(segments.size(), reach * reach);
    from_end_ = from_start_;
  }

  /// Measures the segments [first, last).
  void look(std::size_t first, std::size_t last) {
    std::vector<double> to_segments, to_points;
    for (std::size_t i = first; i < last; ++i) {
      const Segment& s = segments_[i];
      const Vec2 margin = Vec2::Constant(reach_of(i) + half_length_);
      const Vec2 low = s.a.cwiseMin(s.b) - margin, high = s.a.cwiseMax(s.b) + margin, u = s.b - s.a;
      Found found{i, reach_ * reach_, reach_ * reach_};
      const std::ptrdiff_t from = rows_.column(low.x()), to = rows_.column(high.x());
      for (std::ptrdiff_t row = rows_.row(low.y()); row <= rows_.row(high.y()); ++row) {
        const std::size_t begin = rows_.begin(row, from), count = rows_.end(row, to) - begin;
        to_segments.resize(std::max(to_segments.size(), count + 3));
        to_points.resize(to_segments.size());
        distances_to_segments(s.a.x(), s.a.y(),
                              {&ax_[begin], &ay_[begin], &ux_[begin], &uy_[begin], &inverse_[begin]}, count,
                              to_segments.data());
        distances_to_points(s.a.x(), s.a.y(), u.x(), u.y(), inverse(u), {&ax_[begin], &ay_[begin]}, count,
                            to_points.data());
        for (std::size_t k = 0; k < count; ++k) {
          add(found, static_cast<std::size_t>(rows_.order()[begin + k]), to_segments[k], to_points[k]);
        }
      }
      look_at_long_ones(found);
      from_start_[i] = found.own;
      from_end_[curve_.before(i)] = found.before;
    }
  }

  double clearance2(std::size_t segment) const { return std::min(from_start_[segment], from_end_[segment]); }

 private:
  /// The squared distances found so far of a segment and of the one before it, which ends at its start.
  struct Found {
    std::size_t segment;
    double own, before;
  };

  /// How far from segment i others can matter: the next two places along the curve on either side bound what
  /// is found for the segment and for the one before it.
  double reach_of(std::size_t i) const {
    if (curve_.size() < few) return reach_;
    const Segment &s = segments_[i], &after = segments_[curve_.after(i)];
    const double own = std::min(distance_to_segment(after.b, s.a, s.b),
                                distance_to_segment(segments_[curve_.before(i)].a, s.a, s.b));
    const double before = distance_to_segment(s.a, after.a, after.b);
    return std::min(reach_, headroom * std::max(own, before));
  }

  static double inverse(const Vec2& u) {
    const double length2 = u.squaredNorm();
    return length2 > 0 ? 1 / length2 : 0;
  }

  /// `to_segment`: squared distance from the start to segment j; `to_point`: from the segment to the start of
  /// j.
  void add(Found& found, std::size_t j, double to_segment, double to_point) const {
    const std::size_t i = found.segment;
    if (to_point < found.own && j != i && j != curve_.after(i)) found.own = to_point;
    if (to_segment >= found.own && to_segment >= found.before) return;
    const std::size_t before = curve_.before(i);
    if (j == i || j == before) return;
    if (j != curve_.after(i)) found.own = std::min(found.own, to_segment);
    if (j != curve_.before(before)) found.before = std::min(found.before, to_segment);
  }

  void look_at_long_ones(Found& found) const {
    const Segment& s = segments_[found.segment];
    for (const std::int32_t other : rows_.longer()) {
      const auto j = static_cast<std::size_t>(other);
      const Segment& t = segments_[j];
      add(found, j, std::pow(distance_to_segment(s.a, t.a, t.b), 2),
          std::pow(distance_to_segment(t.a, s.a, s.b), 2));
    }
  }

  const Curve& curve_;
  const std::vector<Segment>& segments_;
  SegmentRows rows_;
  double reach_;
  double half_length_ = least_margin;                ///< of the longest segment in rows_, mm
  std::vector<double> ax_, ay_, ux_, uy_, inverse_;  ///< in the order of rows_
  std::vector<double> from_start_, from_end_;        ///< per segment, found at its start and at its end
};

}  // namespace

std::vector<double> freedom(const Curve& curve, const BorderIndex& border, double reach,
                            const Margins& margins, Workers* workers) {
  const std::vector<Segment> segments = curve.segments();
  Workers serial(1);
  Workers& all = workers != nullptr ? *workers : serial;
  Strands strands(curve, segments, reach + margins.self);
  all.ranges(segments.size(), range, [&](std::size_t first, std::size_t last) { strands.look(first, last); });
  double largest = 0;
  for (const Vec2& v : curve.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  const double self_margin = margins.self + rounding * largest;
  const double border_margin = margins.border + rounding * largest;
  std::vector<double> clear(segments.size());
  all.ranges(segments.size(), range, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      clear[i] = std::clamp(std::sqrt(strands.clearance2(i)) - self_margin, 0.0, reach);
      const double to_border =
          border.distance(segments[i].a, segments[i].b, clear[i] + border_margin) - border_margin;
      clear[i] = std::clamp(to_border, 0.0, clear[i]);
    }
  });
  std::vector<double> result(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    result[i] = safe_share * std::min(clear[i], clear[curve.before(i)]);
  }
  return result;
}

std::size_t self_intersections(const Curve& curve) {
  if (curve.size() < 4) return 0;
  const std::vector<Segment> segments = curve.segments();
  const SegmentGrid grid(segments, std::max(mean_length(segments), 1e-9));
  std::size_t count = 0;
  std::vector<std::size_t> seen(segments.size(), segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    grid.near({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}, [&](std::size_t j) {
      if (j <= i || seen[j] == i || neighbours(curve, i, j)) return;
      seen[j] = i;
      if (meet(s, segments[j])) ++count;
    });
  }
  return count;
}

std::size_t segments_outside(const Curve& curve, const BorderIndex& border) {
  std::size_t count = 0;
  for (const Segment& s : curve.segments()) {
    bool bad = !border.contains(s.a);
    border.near({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}, [&](std::size_t e) {
      bad = bad || meet(s, {border.edges()[e].a, border.edges()[e].b});
    });
    if (bad) ++count;
  }
  return count;
}

}  // namespace unicursal::core
