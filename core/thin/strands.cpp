#include "core/thin/strands.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/curve/join.hpp"
#include "core/curve/resample.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/numeric/disjoint_sets.hpp"
#include "core/thin/bands.hpp"
#include "core/thin/thin_axis.hpp"

namespace unicursal::core {
namespace {

// In bead widths, or their squares.
constexpr double widest_of_two = 1.8;  ///< half the width of places in which two strands can still do
constexpr double shortest_four = 3.5;  ///< length of a place of four strands
constexpr double shortest_inner = 2;   ///< length of what is left of it between cuts
constexpr double apart = 0.0075;       ///< distance of two strands on an axis from it
constexpr double growth = 0.003;       ///< by which the whole is grown and shrunk again
constexpr double growth_tolerance = 0.0005;
constexpr double speck = 1e-3;         ///< a smaller piece of the whole is left out
constexpr double pocket = 0.4;         ///< a smaller hole of the whole is filled
constexpr double bend = 0.002;         ///< by which simplification may move the curve
constexpr double longest_side = 0.75;  ///< of the curve in thin places
constexpr double crumb = 0.05;         ///< distance of nodes of the axis that count as one
constexpr double shortest_side = 1e-4;
constexpr double joint_reach = 3;               ///< of a band into a thick place
constexpr double joint_step = 0.2;              ///< between the places that are tried for it
constexpr double joint_depths[] = {0.1, 0.25};  ///< of the band's end behind the strand that it joins
constexpr double joint_clear = 0.1;             ///< between the band and the border
constexpr double one_strand = 1.5;  ///< factor on the length of the strand that a band may replace
constexpr double joint_widths[] = {0.5, 0.3, 0.15, 0.06};  ///< half the width of such a band, best first
constexpr double cut_from_corners = 3;
// As shares of the radius there.
constexpr double inner_half = 0.25;      ///< half the distance of the inner two of four strands
constexpr double one_way_cut_end = 0.3;  ///< from a cut to the end of two strands on the axis
constexpr double one_way_end = 0.5;      ///< by which a strand on the axis is longer than the axis
constexpr double around = 1.5;           ///< how far the axis is followed to find the local width
constexpr double least_corner = 0.2;     ///< by which a corner reaches out of the disc before it
constexpr double most_wide_share = 0.1;  ///< share of a ring of a single strand that may be too wide
constexpr std::size_t fewest_vertices = 5;

class Strands {
 public:
  Strands(const Polygon& region, const ThinPlaces& places, const std::vector<Curve>& thick,
          const StrandWidths& widths)
      : region_(region),
        thin_(places.thin),
        thick_(thick),
        widths_(widths),
        w_(widths.bead),
        border_(region, widths.bead),
        axis_(thin_axis(region, places.thin, widths.bead, widths.least)),
        breaks_(axis_.mouth),
        whole_(axis_.nodes.size() + thick.size()),
        ring_(axis_.nodes.size()),
        four_(axis_.nodes.size()) {}

  /// Whether four strands have room wherever two would be too wide.
  bool have_room() {
    find_places_for_four();
    for (std::size_t n = 0; n < axis_.nodes.size(); ++n) {
      if (axis_.used[n] && !four_[n] && axis_.nodes[n].radius > widest_of_two * w_) return false;
    }
    for (const AxisChain& chain : chains(axis_, breaks_)) {
      const double radius = axis_.nodes[chain[chain.size() / 2]].radius;
      const double halves = 2 * (shortest_inner * w_ + radius - inner_half * radius);
      if (radius > widest_of_two * w_ && !is_end(chain.front()) && !is_end(chain.back()) &&
          length(line(chain)) < halves)
        return false;
    }
    return true;
  }

  std::optional<ThinCurve> lay() {
    for (const Curve& curve : thick_) added_.push_back(counter_clockwise(curve.vertices));
    close_rings();
    find_places_for_four();
    join_thick();
    std::vector<AxisChain> ways = open_chains();
    std::stable_sort(ways.begin(), ways.end(), [&](const AxisChain& l, const AxisChain& r) {
      return length(line(l)) > length(line(r));
    });
    for (const AxisChain& way : ways) lay_way(way);
    for (std::size_t n = 0; n < axis_.nodes.size(); ++n) {
      if (axis_.used[n] && axis_.nodes[n].next.empty()) add_cap(n);
    }
    return curve();
  }

 private:
  static Ring counter_clockwise(Ring ring) {
    if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    return ring;
  }

  bool is_end(std::size_t n) const { return axis_.degree(n) == 1 && !axis_.mouth[n]; }
  bool one_way(double radius) const { return radius < widths_.least; }
  /// Half the distance of the outermost strands.
  double half_band(const BandPoint& p) const {
    if (one_way(p.radius)) return apart * w_;
    return p.four ? p.radius * 3 / 4 : p.radius / 2;
  }
  BandPoint point(std::size_t n) const {
    return {axis_.nodes[n].position, axis_.nodes[n].radius, four_[n] != 0};
  }
  std::vector<BandPoint> line(const AxisChain& chain) const {
    std::vector<BandPoint> points;
    for (const std::size_t n : chain) points.push_back(point(n));
    return points;
  }

  /// Chooses rings of a single strand, long ones first; no two touch.
  void close_rings() {
    std::vector<std::pair<double, AxisChain>> rings;
    for (AxisChain& face : faces(axis_)) {
      if (fits_one_strand(face)) rings.emplace_back(length(line(face)), std::move(face));
    }
    std::stable_sort(rings.begin(), rings.end(),
                     [](const auto& l, const auto& r) { return l.first > r.first; });
    for (const auto& [length, face] : rings) {
      if (std::any_of(face.begin(), face.end(), [&](std::size_t n) { return ring_[n] != 0; })) continue;
      Ring border;
      for (const std::size_t n : face) border.push_back(axis_.nodes[n].position);
      if (std::any_of(thick_.begin(), thick_.end(),
                      [&](const Curve& curve) { return contains(border, curve.vertices.front()); }))
        continue;
      for (std::size_t k = 0; k < face.size(); ++k) {
        ring_[face[k]] = enclosed_.size() + 1;
        breaks_[face[k]] = 1;
        whole_.join(face[k], face.front());
      }
      enclosed_.push_back(border);
      added_.push_back(std::move(border));
    }
  }

  bool fits_one_strand(const AxisChain& face) const {
    double all = 0, wide = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const AxisNode &a = axis_.nodes[face[k]], &b = axis_.nodes[face[(k + 1) % face.size()]];
      const double side = (b.position - a.position).norm();
      all += side;
      if (a.radius + b.radius > widths_.most_single) wide += side;
    }
    return wide <= most_wide_share * all;
  }

  /// All chains that are not sides of a ring of a single strand.
  std::vector<AxisChain> open_chains() const {
    std::vector<AxisChain> result = chains(axis_, breaks_);
    std::erase_if(result, [&](const AxisChain& chain) {
      return chain.size() == 2 && ring_[chain[0]] != 0 && ring_[chain[0]] == ring_[chain[1]];
    });
    return result;
  }

  /// Finds the places for four strands: long stretches, not junctions of narrower ones.
  void find_places_for_four() {
    const double least = std::max(widths_.most_of_two, 2 * widths_.least);
    for (const AxisChain& chain : chains(axis_, breaks_)) {
      for (std::size_t k = 0; k < chain.size();) {
        AxisChain run;
        for (; k < chain.size() && axis_.nodes[chain[k]].radius > least; ++k) run.push_back(chain[k]);
        if (length(line(run)) > shortest_four * w_) {
          for (const std::size_t n : run) four_[n] = 1;
        }
        while (k < chain.size() && axis_.nodes[chain[k]].radius <= least) ++k;
      }
    }
  }

  /// The least radius of the axis near a node: at junctions and bends the axis is farther from the border.
  double radius_around(std::size_t n) const {
    const double reach = around * axis_.nodes[n].radius;
    double least = axis_.nodes[n].radius;
    std::vector<std::size_t> seen{n};
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const AxisNode& node = axis_.nodes[seen[k]];
      if ((node.position - axis_.nodes[n].position).norm() > reach) continue;
      least = std::min(least, node.radius);
      for (const std::size_t next : node.next) {
        if (std::find(seen.begin(), seen.end(), next) == seen.end()) seen.push_back(next);
      }
    }
    return least;
  }

  /// Joins every curve of a thick place to the mouths near it, as far as it is not joined already.
  void join_thick() {
    std::vector<SegmentGrid> grids;
    std::vector<std::vector<Segment>> sides;
    for (const Curve& curve : thick_) sides.push_back(curve.segments());
    for (const std::vector<Segment>& side : sides) grids.emplace_back(side, w_);
    for (std::size_t n = 0; n < axis_.nodes.size(); ++n) {
      if (!axis_.mouth[n]) continue;
      for (std::size_t c = 0; c < thick_.size(); ++c) {
        if (whole_.same(n, axis_.nodes.size() + c)) continue;
        const double half = half_band(point(n));
        for (const double share : joint_widths) {
          const double narrower = std::min(share * w_, half);
          const std::optional<Vec2> end = joint(n, narrower, sides[c], grids[c]);
          if (!end) continue;
          whole_.join(n, axis_.nodes.size() + c);
          add_band({point(n), {*end, axis_.nodes[n].radius, false}}, BandEnds::round, narrower);
          break;
        }
      }
    }
  }

  /// Where a band from a mouth is to end: just behind the strand that it meets first. The band may cross
  /// nothing else.
  std::optional<Vec2> joint(std::size_t mouth, double half, const std::vector<Segment>& sides,
                            const SegmentGrid& grid) const {
    const Vec2 from = axis_.nodes[mouth].position;
    const Vec2 reach = Vec2(1, 1) * joint_reach * w_;
    std::vector<std::pair<double, Vec2>> ends;
    std::vector<std::size_t> near;
    grid.near({from - reach, from + reach}, [&](std::size_t k) { near.push_back(k); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t k : near) {
      const Segment& side = sides[k];
      const double long_side = (side.b - side.a).norm();
      const auto steps = static_cast<int>(std::ceil(long_side / (joint_step * w_)));
      for (int i = 0; i < steps; ++i) {
        const Vec2 at = side.a + (i + 0.5) / steps * (side.b - side.a);
        const double away = (at - from).norm();
        if (away > joint_reach * w_ || away < 1e-6) continue;
        // A band that meets the strand at a right angle is best.
        const double slope = std::abs(cross((at - from) / away, (side.b - side.a) / long_side));
        for (const double depth : joint_depths)
          ends.emplace_back(away + depth * w_ + (1 - slope) * w_, at + depth * w_ * (at - from) / away);
      }
    }
    std::stable_sort(ends.begin(), ends.end(),
                     [](const auto& l, const auto& r) { return l.first < r.first; });
    for (const auto& [cost, end] : ends) {
      if (free(from, end, half, sides, grid)) return end;
    }
    return std::nullopt;
  }

  bool free(const Vec2& from, const Vec2& to, double half, const std::vector<Segment>& sides,
            const SegmentGrid& grid) const {
    const double clear = half + joint_clear * w_;
    if (border_.distance((from + to) / 2, to, clear) < clear) return false;
    const Vec2 aside = half * perpendicular((to - from).normalized());
    std::vector<std::size_t> crossed;
    for (const Vec2& shift : {Vec2(0, 0), aside, Vec2(-aside)}) {
      const Vec2 a = from + shift, b = to + shift;
      std::vector<std::size_t> met;
      grid.near({a.cwiseMin(b), a.cwiseMax(b)}, [&](std::size_t k) {
        if (distance_between_segments(a, b, sides[k].a, sides[k].b) == 0) met.push_back(k);
      });
      std::sort(met.begin(), met.end());
      met.erase(std::unique(met.begin(), met.end()), met.end());
      if (met.size() != 1) return false;
      crossed.push_back(met.front());
    }
    // All three meet the same strand: two strands would enclose a pocket.
    for (const std::size_t k : crossed) {
      double forwards = 0, backwards = 0;
      for (std::size_t i = crossed.front(); i != k; i = i + 1 < sides.size() ? i + 1 : 0)
        forwards += (sides[i].b - sides[i].a).norm();
      for (std::size_t i = k; i != crossed.front(); i = i + 1 < sides.size() ? i + 1 : 0)
        backwards += (sides[i].b - sides[i].a).norm();
      if (std::min(forwards, backwards) > one_strand * (half + w_ / 2)) return false;
    }
    return true;
  }

  void lay_way(const AxisChain& way) {
    std::vector<BandPoint> points = line(way);
    const std::size_t first = way.front(), last = way.back();
    if (whole_.join(first, last)) {
      if (axis_.degree(first) == 1 && !axis_.mouth[first] && ring_[first] == 0) end_at(first, points, true);
      if (axis_.degree(last) == 1 && !axis_.mouth[last] && ring_[last] == 0) end_at(last, points, false);
      for (const std::size_t n : way) whole_.join(n, first);
      add_band(points, BandEnds::round);
      add_inner(points, BandEnds::round);
      for (std::size_t k = 1; k + 1 < way.size(); ++k) {
        if (is_corner(way[k])) add_cap(way[k]);
      }
      for (const std::size_t n : {first, last}) {
        if (axis_.degree(n) > 1 && ring_[n] == 0 && is_corner(n)) add_cap(n);
      }
      return;
    }
    // It would close a ring: two bands end at a place far from its corners.
    const std::size_t cut = place_of_cut(way);
    const double radius = axis_.nodes[way[cut]].radius;
    const double inner_short_of = radius - inner_half * radius;
    std::vector<BandPoint> before(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(cut) + 1);
    std::vector<BandPoint> behind(points.rbegin(), points.rend() - static_cast<std::ptrdiff_t>(cut));
    for (std::vector<BandPoint>* part : {&before, &behind}) {
      keep_two_where_short(*part, inner_short_of);
      const double short_of = one_way(radius) ? one_way_cut_end * radius : radius - half_band(part->back());
      add_band(shortened(*part, length(*part) - short_of), BandEnds::round_front);
      add_inner(shortened(*part, length(*part) - inner_short_of), BandEnds::round_front);
    }
    for (std::size_t k = 1; k + 1 < way.size(); ++k) {
      if (is_corner(way[k]) && k != cut) add_cap(way[k]);
    }
  }

  /// Gives up four strands where a cut leaves too little room for the inner two: the outer two alone would
  /// leave the middle bare.
  void keep_two_where_short(std::vector<BandPoint>& line, double inner_short_of) {
    for (std::size_t k = 0; k < line.size();) {
      std::vector<BandPoint> run;
      const std::size_t first = k;
      for (; k < line.size() && line[k].four; ++k) run.push_back(line[k]);
      const bool cut = k == line.size() && k > first;
      if (length(run) - (cut ? inner_short_of : 0) <= shortest_inner * w_) {
        for (std::size_t p = first; p < k; ++p) line[p].four = false;
      }
      while (k < line.size() && !line[k].four) ++k;
    }
  }

  bool is_corner(std::size_t n) const { return axis_.corner[n] > least_corner * axis_.nodes[n].radius; }

  /// The node of a chain that is farthest from its ends and corners; among those that are far enough, the one
  /// nearest to the middle.
  std::size_t place_of_cut(const AxisChain& way) const {
    std::vector<double> at{0};
    for (std::size_t k = 1; k < way.size(); ++k)
      at.push_back(at.back() + (axis_.nodes[way[k]].position - axis_.nodes[way[k - 1]].position).norm());
    std::vector<double> corners{0, at.back()};
    for (std::size_t k = 1; k + 1 < way.size(); ++k) {
      if (is_corner(way[k])) corners.push_back(at[k]);
    }
    std::size_t best = way.size() / 2;
    double most = -1, middle = 0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      double away = cut_from_corners * w_;
      for (const double corner : corners) away = std::min(away, std::abs(at[k] - corner));
      const double off = std::abs(at[k] - at.back() / 2);
      if (away > most || (away == most && off < middle)) best = k, most = away, middle = off;
    }
    return best;
  }

  /// The end of a place: a cap, or a longer strand.
  void end_at(std::size_t n, std::vector<BandPoint>& points, bool front) {
    const double radius = axis_.nodes[n].radius;
    if (!one_way(radius)) return add_cap(n);
    if (points.size() < 2) return;
    const Vec2 before = front ? points[1].position : points[points.size() - 2].position;
    const Vec2 here = axis_.nodes[n].position;
    const BandPoint longer{here + one_way_end * radius * (here - before).normalized(), radius, false};
    points.insert(front ? points.begin() : points.end(), longer);
  }

  /// What lies half of the local width inside the border, near a node: it follows the shape of a wall's end
  /// or of a bend.
  void add_cap(std::size_t n) {
    if (axis_.mouth[n]) return;
    const AxisNode& node = axis_.nodes[n];
    const double radius = radius_around(n);
    if (one_way(radius) && !node.next.empty()) return;
    // A place that is hardly longer than wide gets a loop, however narrow.
    const double depth =
        node.next.empty() ? radius / 2 : radius - half_band({node.position, radius, four_[n] != 0});
    for (const Polygon& piece : intersect(cap(region_, node.position, node.radius, depth), thin_)) {
      if (piece.holes.empty() && contains(piece.outer, node.position))
        side_of(node.position).push_back(piece.outer);
    }
  }

  /// What is inside a ring of a single strand is taken away from what that encloses; else it is added.
  std::vector<Ring>& side_of(const Vec2& p) {
    const bool inside =
        std::any_of(enclosed_.begin(), enclosed_.end(), [&](const Ring& ring) { return contains(ring, p); });
    return inside ? removed_ : added_;
  }

  void add_band(const std::vector<BandPoint>& line, BandEnds ends,
                double most = std::numeric_limits<double>::infinity()) {
    const std::vector<BandPoint> points = without_crumbs(line, crumb * w_);
    if (length(points) <= 0) return;
    std::vector<double> halves;
    for (const BandPoint& p : points) halves.push_back(std::min(half_band(p), most));
    std::vector<Ring> rings = band(points, halves, ends);
    std::vector<Ring>& to =
        side_of((points[points.size() / 2 - 1].position + points[points.size() / 2].position) / 2);
    std::move(rings.begin(), rings.end(), std::back_inserter(to));
    for (std::size_t k = 0; k < points.size();) {
      OneWay stretch{{}, apart * w_};
      for (; k < points.size() && one_way(points[k].radius); ++k) stretch.axis.push_back(points[k].position);
      if (stretch.axis.size() > 1) one_way_.push_back(std::move(stretch));
      while (k < points.size() && !one_way(points[k].radius)) ++k;
    }
  }

  /// Where there is room for four strands, the inner two are a loop of their own.
  void add_inner(const std::vector<BandPoint>& line, BandEnds ends) {
    const std::vector<BandPoint> points = without_crumbs(line, crumb * w_);
    for (std::size_t k = 0; k < points.size();) {
      std::vector<BandPoint> run;
      for (; k < points.size() && points[k].four; ++k) run.push_back(points[k]);
      if (length(run) > shortest_inner * w_) {
        std::vector<double> halves;
        for (const BandPoint& p : run) halves.push_back(inner_half * p.radius);
        std::vector<Ring> rings = band(run, halves, k == points.size() ? ends : BandEnds::round);
        std::move(rings.begin(), rings.end(), std::back_inserter(inner_));
      }
      while (k < points.size() && !points[k].four) ++k;
    }
  }

  Curve cleaned(const Ring& rough) const {
    Ring ring;
    for (const Vec2& v : rough) {
      if (ring.empty() || (v - ring.back()).norm() > shortest_side * w_) ring.push_back(v);
    }
    Curve result{simplified(ring, bend * w_)};
    while (result.size() < fewest_vertices) result = subdivided(result);
    return result;
  }

  std::optional<ThinCurve> curve() {
    if (added_.empty()) return std::nullopt;
    Region sum = enclosed(added_, FillRule::non_zero);
    if (!removed_.empty()) sum = subtract(sum, enclosed(removed_, FillRule::non_zero));
    // Where the border meets itself in a point, a little growth makes it pass.
    sum = offset(offset(sum, growth * w_, growth_tolerance * w_), -growth * w_, growth_tolerance * w_);
    std::erase_if(sum, [&](const Polygon& piece) { return area(piece) < speck * w_ * w_; });
    // One ring, if no band was missing and none closed a ring in spite of the cuts, as caps may do.
    std::vector<Curve> loops;
    const auto add_loops = [&](const Polygon& piece) {
      loops.push_back(cleaned(piece.outer));
      for (const Ring& hole : piece.holes) {
        if (-signed_area(hole) > pocket * w_ * w_) loops.push_back(cleaned(hole));
      }
    };
    for (const Polygon& piece : sum) add_loops(piece);
    if (!inner_.empty()) {
      for (const Polygon& piece : enclosed(inner_, FillRule::non_zero)) add_loops(piece);
    }
    std::optional<Curve> whole = joined(std::move(loops), region_, w_);
    if (!whole) return std::nullopt;
    ThinCurve result{std::move(*whole), std::move(one_way_)};
    Ring fine;
    for (std::size_t i = 0; i < result.curve.size(); ++i) {
      const Vec2 &a = result.curve.vertices[i], &b = result.curve.vertices[result.curve.after(i)];
      const double pieces = std::max(std::ceil((b - a).norm() / (longest_side * w_)), 1.0);
      for (double k = 0; k < pieces; ++k) fine.push_back(a + k / pieces * (b - a));
    }
    result.curve.vertices = std::move(fine);
    return result;
  }

  const Polygon& region_;
  const Region& thin_;
  const std::vector<Curve>& thick_;
  const StrandWidths& widths_;
  double w_;
  BorderIndex border_;
  ThinAxis axis_;
  std::vector<char> breaks_;
  DisjointSets whole_;             ///< nodes of the axis, then thick curves: what is connected already
  std::vector<std::size_t> ring_;  ///< of each node: number of its ring of a single strand, 0 if it has none
  std::vector<char> four_;         ///< of each node: whether four strands run there
  std::vector<Ring> enclosed_, added_, removed_, inner_;
  std::vector<OneWay> one_way_;
};

/// Where a side of the curve lies on a stretch of an axis.
struct OnAxis {
  std::size_t side = 0;
  double from = 0, to = 0;
};

}  // namespace

std::optional<ThinCurve> lay_strands(const Polygon& region, const ThinPlaces& places,
                                     const std::vector<Curve>& thick_curves, const StrandWidths& widths) {
  return Strands(region, places, thick_curves, widths).lay();
}

bool have_room(const Polygon& region, const ThinPlaces& places, const StrandWidths& widths) {
  return Strands(region, places, {}, widths).have_room();
}

void empty_ways_back(const Curve& curve, const std::vector<OneWay>& one_way, std::vector<double>& areas) {
  if (one_way.empty()) return;
  constexpr double near = 1.6;  // distances of the strands from the axis
  std::vector<Segment> all;
  std::vector<std::pair<std::size_t, double>> places;  // stretch, and position of the segment's start on it
  double pitch = 0;
  for (std::size_t s = 0; s < one_way.size(); ++s) {
    double from = 0;
    for (std::size_t k = 0; k + 1 < one_way[s].axis.size(); ++k) {
      all.push_back({one_way[s].axis[k], one_way[s].axis[k + 1]});
      places.emplace_back(s, from);
      from += (all.back().b - all.back().a).norm();
    }
    pitch = std::max(pitch, 10 * one_way[s].apart);
  }
  const SegmentGrid grid(all, pitch);
  std::vector<std::vector<OnAxis>> forth(one_way.size()), back(one_way.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &a = curve.vertices[i], &b = curve.vertices[curve.after(i)];
    const Vec2 middle = (a + b) / 2, margin(pitch, pitch);
    std::size_t best = all.size();
    double distance = pitch;
    grid.near({middle - margin, middle + margin}, [&](std::size_t k) {
      const double d = distance_to_segment(middle, all[k].a, all[k].b);
      if (d < distance || (d == distance && k < best)) distance = d, best = k;
    });
    if (best == all.size() || distance > near * one_way[places[best].first].apart) continue;
    const auto [stretch, start] = places[best];
    const Vec2 along = (all[best].b - all[best].a).normalized();
    const double way = (b - a).dot(along);
    if (std::abs(way) < 0.5 * (b - a).norm()) continue;
    const double at = start + (middle - all[best].a).dot(along), half = (b - a).norm() / 2;
    (way > 0 ? forth : back)[stretch].push_back({i, at - half, at + half});
  }
  for (std::size_t s = 0; s < one_way.size(); ++s) {
    std::sort(forth[s].begin(), forth[s].end(), [](const OnAxis& l, const OnAxis& r) {
      return std::pair(l.from, l.side) < std::pair(r.from, r.side);
    });
    for (const OnAxis& empty : back[s]) {
      double covered = 0;
      const auto overlap = [&](const OnAxis& side) {
        return std::max(std::min(side.to, empty.to) - std::max(side.from, empty.from), 0.0);
      };
      for (const OnAxis& side : forth[s]) covered += overlap(side);
      if (covered <= 0) continue;
      for (const OnAxis& side : forth[s]) areas[side.side] += overlap(side) / covered * areas[empty.side];
      areas[empty.side] = 0;
    }
  }
}

}  // namespace unicursal::core
