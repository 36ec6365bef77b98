#include "tests/bench/paper/fermat_spirals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/curve/fairing.hpp"
#include "core/curve/join.hpp"
#include "core/curve/resample.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/region.hpp"
#include "core/numeric/disjoint_sets.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;
using core::Region;
using core::Vec2;

// All in bead widths.
constexpr double arc_tolerance = 0.005;
constexpr double thinnest_band = 0.3;   ///< thinner pieces of bands are left out
constexpr double farthest_link = 2.6;   ///< between bands that face each other
constexpr double sampling = 0.2;        ///< between the places that are tried for links and cuts
constexpr double longer_by = 0.35;      ///< than the shortest link or cut, if it lies better
constexpr double into_gap = 0.45;       ///< how far a cut reaches beyond the band
constexpr double rounding = 0.25;       ///< radius of rounded corners
constexpr double vertex_spacing = 0.4;  ///< of the curve that is smoothed
constexpr int smoothings = 3;           ///< of five steps each

struct Nearest {
  Vec2 point{0, 0};
  std::size_t ring = 0;
  double distance = 0;
};

/// The nearest point of the border's rings that `wanted` accepts, within `reach`.
template <typename Wanted>
std::optional<Nearest> nearest(const core::BorderIndex& border, const Vec2& p, double reach, Wanted wanted) {
  std::optional<Nearest> best;
  border.near({p - Vec2::Constant(reach), p + Vec2::Constant(reach)}, [&](std::size_t e) {
    const core::BorderEdge& edge = border.edges()[e];
    if (!wanted(edge.ring)) return;
    const Vec2 along = edge.b - edge.a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - edge.a).dot(along) / length2, 0.0, 1.0) : 0.0;
    const Vec2 point = edge.a + t * along;
    const double distance = (point - p).norm();
    if (distance <= (best ? best->distance : reach)) best = Nearest{point, edge.ring, distance};
  });
  return best;
}

bool any_ring(std::size_t) {
  return true;
}

/// A straight strip across a band (a cut), or between two bands (a link).
struct Strip {
  Vec2 from{0, 0}, to{0, 0};

  Vec2 middle() const { return (from + to) / 2; }
  double length() const { return (to - from).norm(); }
};

struct Band {
  Polygon shape;
  int level = 0;  ///< 0 is the outermost
  core::BorderIndex border;
  std::vector<Vec2> cuts, links;          ///< where they lie on the middle of the band
  std::vector<std::optional<Vec2>> gate;  ///< per ring: the cut that opens it

  Band(Polygon polygon, int depth, double w)
      : shape(std::move(polygon)), level(depth), border(shape, w), gate(border.ring_count()) {}

  const core::Ring& ring(std::size_t r) const { return r == 0 ? shape.outer : shape.holes[r - 1]; }
};

/// Points along a ring, `step` apart.
std::vector<Vec2> samples_along(const core::Ring& ring, double step) {
  std::vector<Vec2> samples;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const auto pieces = static_cast<int>(std::ceil((b - a).norm() / step));
    for (int k = 0; k < pieces; ++k) samples.push_back(a + (k + 0.5) / pieces * (b - a));
  }
  return samples;
}

double least_distance(const std::vector<Vec2>& points, const Vec2& p) {
  double least = 1e300;
  for (const Vec2& other : points) least = std::min(least, (other - p).norm());
  return least;
}

class Spirals {
 public:
  Spirals(const Polygon& island, double w) : island_(island), w_(w) { make_bands(); }

  std::vector<core::Curve> curves() {
    if (bands_.empty()) return {};
    make_tree();
    std::vector<char> done(bands_.size(), false);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      if (!done[b]) wind(b, done);
    }
    Region whole = core::unite(core::subtract(all_bands(), strips(cuts_)), strips(links_));
    for (const double r : {-rounding, rounding}) {
      whole = core::offset(core::offset(whole, r * w_, arc_tolerance * w_), -r * w_, arc_tolerance * w_);
    }
    std::vector<core::Curve> result;
    for (const Polygon& polygon : whole) {
      for (core::Curve& curve : joined_rings(polygon)) result.push_back(std::move(curve));
    }
    return result;
  }

 private:
  void make_bands() {
    for (int level = 0;; ++level) {
      const double depth = 2 * level + 0.5;
      const Region outer = core::offset({island_}, -depth * w_, arc_tolerance * w_);
      if (outer.empty()) break;
      const Region inner = core::offset({island_}, -(depth + 1) * w_, arc_tolerance * w_);
      const Region band =
          core::opened(core::subtract(outer, inner), thinnest_band / 2 * w_, arc_tolerance * w_);
      for (const Polygon& piece : band) bands_.emplace_back(piece, level, w_);
    }
    std::stable_sort(bands_.begin(), bands_.end(), [](const Band& a, const Band& b) {
      return core::area(Polygon{a.shape.outer, {}}) > core::area(Polygon{b.shape.outer, {}});
    });
  }

  /// The places where a strip can lead from one band to another, and the shortest one's length.
  std::vector<Strip> crossings(const Band& from, const Band& to) const {
    std::vector<Strip> found;
    const core::Box a = core::bounds(from.shape), b = core::bounds(to.shape);
    const Vec2 reach = Vec2::Constant(farthest_link * w_);
    if (((a.max + reach).array() < b.min.array()).any() || ((b.max + reach).array() < a.min.array()).any())
      return found;
    for (std::size_t r = 0; r < from.border.ring_count(); ++r) {
      for (const Vec2& p : samples_along(from.ring(r), sampling * w_)) {
        if (const auto q = nearest(to.border, p, farthest_link * w_, any_ring))
          found.push_back({p, q->point});
      }
    }
    return found;
  }

  static double shortest(const std::vector<Strip>& strips) {
    double least = 1e300;
    for (const Strip& strip : strips) least = std::min(least, strip.length());
    return least;
  }

  void make_tree() {
    struct Facing {
      std::size_t a = 0, b = 0;
      double distance = 0;
    };
    std::vector<Facing> facing;
    for (std::size_t a = 0; a < bands_.size(); ++a) {
      for (std::size_t b = a + 1; b < bands_.size(); ++b) {
        if (std::abs(bands_[a].level - bands_[b].level) > 1) continue;
        const std::vector<Strip> between = crossings(bands_[a], bands_[b]);
        if (!between.empty()) facing.push_back({a, b, shortest(between)});
      }
    }
    std::stable_sort(facing.begin(), facing.end(),
                     [](const Facing& l, const Facing& r) { return l.distance < r.distance; });
    core::DisjointSets sets(bands_.size());
    children_.resize(bands_.size());
    for (const Facing& f : facing) {
      if (!sets.join(f.a, f.b)) continue;
      children_[f.a].push_back(f.b);
      children_[f.b].push_back(f.a);
    }
  }

  /// Cuts the bands of a tree open and links each to its children.
  void wind(std::size_t root, std::vector<char>& done) {
    std::vector<std::pair<std::size_t, std::optional<Vec2>>> open{{root, std::nullopt}};
    done[root] = true;
    while (!open.empty()) {
      const auto [b, gate] = open.back();
      open.pop_back();
      cut_open(bands_[b], gate);
      for (const std::size_t child : children_[b]) {
        if (done[child]) continue;
        done[child] = true;
        open.emplace_back(child, link(bands_[b], bands_[child]));
      }
    }
  }

  /// Cuts until every hole of the band is open to the outside, each as near to `wish` as it can be.
  void cut_open(Band& band, const std::optional<Vec2>& wish) {
    std::vector<char> open(band.border.ring_count(), false);
    open[0] = true;
    for (std::size_t todo = band.border.ring_count() - 1; todo > 0; --todo) {
      std::vector<Strip> tries;
      std::vector<std::size_t> ring_of;
      for (std::size_t r = 1; r < open.size(); ++r) {
        if (open[r]) continue;
        for (const Vec2& p : samples_along(band.ring(r), sampling * w_)) {
          const auto q = nearest(band.border, p, farthest_link * w_, [&](std::size_t s) { return open[s]; });
          if (!q) continue;
          tries.push_back({p, q->point});
          ring_of.push_back(r);
        }
      }
      const std::optional<std::size_t> best = choose(tries, band, wish, 2, 1);
      if (!best) return;  // a ring that stays closed is joined at the end
      const Strip& cut = tries[*best];
      open[ring_of[*best]] = true;
      band.cuts.push_back(cut.middle());
      band.gate[ring_of[*best]] = cut.middle();
      const Vec2 beyond = into_gap * w_ * (cut.to - cut.from) / std::max(cut.length(), 1e-9);
      cuts_.push_back({cut.from - beyond, cut.to + beyond});
    }
  }

  /// Links the band to a child beside the cut that opened the ring between them; returns where the child is
  /// best cut.
  std::optional<Vec2> link(Band& band, Band& child) {
    const std::vector<Strip> tries = crossings(child, band);
    std::optional<Vec2> wish;
    if (!tries.empty()) {
      const auto facing = nearest(band.border, tries.front().to, w_, any_ring);
      if (facing && band.gate[facing->ring]) wish = band.gate[facing->ring];
    }
    if (!wish && !band.cuts.empty()) wish = band.cuts.front();
    const std::optional<std::size_t> best = choose(tries, band, wish, 1, 2);
    if (!best) return std::nullopt;
    const Strip& found = tries[*best];
    const Vec2 across = (found.from - found.to) / std::max(found.length(), 1e-9);
    const Strip link{found.to - w_ / 2 * across, found.from + w_ / 2 * across};
    links_.push_back(link);
    band.links.push_back(link.from);
    child.links.push_back(link.to);
    // Seen from the parent always on the same side, so that the spiral winds on.
    return Vec2(link.to + w_ * core::perpendicular(across));
  }

  /// The short strip nearest to `wish` that keeps these distances, in bead widths, from the band's cuts and
  /// links; if none does, the one that keeps most of them.
  std::optional<std::size_t> choose(const std::vector<Strip>& tries, const Band& band,
                                    const std::optional<Vec2>& wish, double from_cuts,
                                    double from_links) const {
    std::optional<std::size_t> best;
    std::pair<double, double> best_rank;
    const double limit = shortest(tries) + longer_by * w_;
    for (std::size_t k = 0; k < tries.size(); ++k) {
      if (tries[k].length() > limit) continue;
      const bool cut = from_cuts > from_links;
      const Vec2 across = (tries[k].from - tries[k].to) / std::max(tries[k].length(), 1e-9);
      const Vec2 at = cut ? tries[k].middle() : Vec2(tries[k].to - w_ / 2 * across);
      const double room = std::min({least_distance(band.cuts, at) / (from_cuts * w_),
                                    least_distance(band.links, at) / (from_links * w_), 0.98});
      const std::pair rank(-room, wish ? (at - *wish).norm() : tries[k].length());
      if (!best || rank < best_rank) best = k, best_rank = rank;
    }
    return best;
  }

  Region all_bands() const {
    Region region;
    for (const Band& band : bands_) region.push_back(band.shape);
    return region;
  }

  Region strips(const std::vector<Strip>& strips) const {
    std::vector<core::Ring> rings;
    for (const Strip& strip : strips) {
      const Vec2 side = w_ / 2 * core::perpendicular(strip.to - strip.from) / std::max(strip.length(), 1e-9);
      rings.push_back({strip.from - side, strip.to - side, strip.to + side, strip.from + side});
    }
    return core::enclosed(rings, core::FillRule::non_zero);
  }

  /// The border of a piece as one curve if possible.
  std::vector<core::Curve> joined_rings(const Polygon& polygon) const {
    std::vector<core::Curve> rings{{polygon.outer}};
    for (const core::Ring& hole : polygon.holes) rings.push_back({hole});
    if (rings.size() > 1) {
      if (std::optional<core::Curve> one = core::joined(rings, island_, w_)) return {*one};
    }
    return rings;
  }

  const Polygon& island_;
  double w_;
  std::vector<Band> bands_;
  std::vector<std::vector<std::size_t>> children_;  ///< neighbours in the tree
  std::vector<Strip> cuts_, links_;
};

/// A few explicit steps of smoothing, if the curve is one that they apply to.
core::Ring smooth(const core::Ring& ring, const Polygon& island, double w) {
  core::Curve curve{ring};
  const core::BorderIndex border(island, w);
  if (curve.size() < 5 || core::self_intersections(curve) > 0 || core::segments_outside(curve, border) > 0)
    return ring;
  curve = core::respaced(curve, border, vertex_spacing * w);
  for (int k = 0; k < smoothings; ++k) curve = core::smoothed(curve, island, w);
  return curve.vertices;
}

}  // namespace

Filling fermat_spirals(const Polygon& island, double bead_width) {
  Filling filling;
  for (const core::Curve& curve : Spirals(island, bead_width).curves())
    filling.lines.push_back({smooth(curve.vertices, island, bead_width), true});
  return filling;
}

}  // namespace unicursal::bench
