#include "tests/bench/paper/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/curve/clearance.hpp"
#include "core/curve/resample.hpp"
#include "core/geometry/border_index.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::bench {
namespace {

using core::Curve;
using core::Polygon;
using core::Vec2;

constexpr double edge_length = 0.4;      ///< of the resampled curve, spacings
constexpr double own_stretch = 1.3;      ///< along the curve nothing repels, spacings
constexpr double longest_step = 0.15;    ///< spacings
constexpr double least_distance = 0.35;  ///< nearer ones repel as from here, spacings
constexpr double slide = 0.2;           ///< share of the way to the middle of the neighbours, along the curve
constexpr double relaxed = 0.2;         ///< of the push, in the end
constexpr double most_bare = 0.03;      ///< a curve that leaves more was given up
constexpr std::size_t look_every = 25;  ///< iterations between looks at what is covered
constexpr std::size_t coarse_looks = 6;   ///< looks without progress before the spacing is halved
constexpr double least_progress = 0.002;  ///< of the island's area
constexpr double far = 0.75;              ///< bead widths; what is farther from the curve is bare
constexpr int start_corners = 16;

/// The share of the lattice that is farther than 0.75 spacings from the curve.
double bare_share_of(const core::Lattice& lattice, const Curve& curve, double spacing) {
  core::LatticeOwners owners(lattice);
  owners.assign(curve.segments());
  double bare = 0, all = 0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const double weight = lattice.weight(k);
    if (!(weight > 0)) continue;
    all += weight;
    if (owners.distance2(k) > far * far * spacing * spacing) bare += weight;
  }
  return bare / all;
}

/// A circle of at most the coarsest spacing around the sample that is farthest from the border.
Curve first_circle(const Polygon& island, const core::Lattice& lattice, double w, double coarsest) {
  const core::BorderIndex border(island, w);
  core::LatticeOwners owners(lattice);
  std::vector<core::Segment> edges;
  for (const core::BorderEdge& edge : border.edges()) edges.push_back({edge.a, edge.b});
  owners.assign(edges);
  std::optional<std::size_t> widest;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (!(lattice.weight(k) > 0) || !border.contains(lattice.position(k))) continue;
    if (!widest || owners.distance2(k) > owners.distance2(*widest)) widest = k;
  }
  Curve circle;
  if (!widest) return circle;
  const double radius = 0.8 * std::min(std::sqrt(owners.distance2(*widest)), coarsest);
  for (int k = 0; k < start_corners; ++k) {
    const double turn = 2 * std::numbers::pi * k / start_corners;
    circle.vertices.push_back(lattice.position(*widest) + radius * Vec2(std::cos(turn), std::sin(turn)));
  }
  return circle;
}

class Growing {
 public:
  Growing(const Polygon& island, double w, const GrowthOptions& options)
      : island_(island),
        w_(w),
        area_(core::area(island)),
        options_(options),
        random_(options.seed),
        border_(island, w),
        lattice_(core::sample(island, w / 3)),
        curve_(first_circle(island, lattice_, w, options.coarsest * w)) {}

  Filling run() {
    Filling filling;
    if (curve_.size() < 5) return filling;
    std::uint64_t moves = 0;
    std::size_t stalled = 0;
    double best_bare = 1;
    spacing_ = options_.coarsest * w_;
    for (bool growing = true; growing && moves < options_.most_moves; ++filling.iterations) {
      if (filling.iterations % look_every == 0) {
        const double bare = bare_share_of(lattice_, curve_, spacing_);
        stalled = bare < best_bare - least_progress ? 0 : stalled + 1;
        best_bare = std::min(best_bare, bare);
        const bool last = spacing_ <= w_ * 1.001;
        if (last) {
          growing = bare > options_.bare_share && stalled * look_every <= options_.patience;
        } else if (bare <= options_.bare_share || stalled > coarse_looks) {
          spacing_ = std::max(w_, spacing_ / 2);
          stalled = 0;
          best_bare = 1;
        }
      }
      moves += curve_.size();
      step(options_.stretch);
    }
    for (std::size_t k = 0; k < options_.relaxation; ++k, ++filling.iterations)
      step(relaxed * options_.stretch);
    filling.finished = bare_share_of(lattice_, curve_, w_) < most_bare;
    filling.lines.push_back({curve_.vertices, true});
    return filling;
  }

 private:
  /// One iteration, in which edges push their ends apart by `push`.
  void step(double push) {
    curve_ = core::respaced(curve_, border_, edge_length * spacing_);
    const std::vector<core::Segment> segments = curve_.segments();
    const core::SegmentGrid grid(segments, spacing_);
    std::vector<double> starts(segments.size());
    double length = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      starts[i] = length;
      length += (segments[i].b - segments[i].a).norm();
    }
    // Bends across the curve; along it, vertices only even out.
    std::vector<Vec2> moves(curve_.size()), bends(curve_.size()), slides(curve_.size());
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      const Vec2 &next = curve_.vertices[curve_.after(i)], &before = curve_.vertices[curve_.before(i)];
      const Vec2 middle = (next + before) / 2 - curve_.vertices[i], along = next - before;
      const double length2 = along.squaredNorm();
      slides[i] = length2 > 0 ? Vec2(middle.dot(along) / length2 * along) : Vec2(0, 0);
      bends[i] = middle - slides[i];
    }
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      const Vec2& p = curve_.vertices[i];
      const Vec2 noise(random_.uniform(-1, 1), random_.uniform(-1, 1));
      const Vec2 around = (bends[curve_.after(i)] + bends[curve_.before(i)]) / 2;
      const Vec2 fair = options_.fairing * (bends[i] - around) - 2 * push * bends[i];
      moves[i] = options_.brownian * spacing_ * noise + slide * slides[i] + fair +
                 from_strands(i, segments, grid, starts, length) + from_border(p);
      const double norm = moves[i].norm();
      if (norm > longest_step * spacing_) moves[i] *= longest_step * spacing_ / norm;
    }
    const std::vector<double> free =
        core::freedom(curve_, border_, spacing_, {0.05 * w_, 0.05 * w_}, nullptr);
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      const double norm = moves[i].norm();
      curve_.vertices[i] += norm > free[i] ? Vec2(moves[i] * (free[i] / norm)) : moves[i];
    }
  }

  Vec2 from_strands(std::size_t i, const std::vector<core::Segment>& segments, const core::SegmentGrid& grid,
                    const std::vector<double>& starts, double length) {
    const Vec2& p = curve_.vertices[i];
    const double reach = options_.reach * spacing_;
    Vec2 sum(0, 0);
    seen_.resize(std::max(seen_.size(), segments.size()));
    ++look_;
    // Of each stretch only the nearest point counts: each segment's share is its length in spacings.
    grid.near({p - Vec2::Constant(reach), p + Vec2::Constant(reach)}, [&](std::size_t j) {
      if (seen_[j] == look_) return;
      seen_[j] = look_;
      const double ahead = std::abs(starts[j] - starts[i]);
      if (std::min(ahead, length - ahead) < own_stretch * spacing_) return;
      const core::Segment& s = segments[j];
      const Vec2 along = s.b - s.a;
      const double length2 = along.squaredNorm();
      const double t = length2 > 0 ? std::clamp((p - s.a).dot(along) / length2, 0.0, 1.0) : 0.0;
      const Vec2 away = p - s.a - t * along;
      const double r = away.norm();
      if (r > reach || !(r > 0)) return;
      // (σ/r)^12 − (σ/r)^6 is zero at σ, the spacing.
      const double q = std::pow(spacing_ / std::max(r, least_distance * spacing_), 6);
      const double force = std::min(q * q - q, 4.0) * (q < 1 ? options_.attraction : 1.0);
      sum += std::sqrt(length2) / spacing_ * force / r * away;
    });
    return options_.repulsion * spacing_ * sum;
  }

  Vec2 from_border(const Vec2& p) const {
    const double wanted = spacing_ / 2;
    std::optional<double> least;
    Vec2 push(0, 0);
    border_.near({p - Vec2::Constant(wanted), p + Vec2::Constant(wanted)}, [&](std::size_t e) {
      const core::BorderEdge& edge = border_.edges()[e];
      const Vec2 along = edge.b - edge.a;
      const double length2 = along.squaredNorm();
      const double t = length2 > 0 ? std::clamp((p - edge.a).dot(along) / length2, 0.0, 1.0) : 0.0;
      const Vec2 away = p - edge.a - t * along;
      const double r = away.norm();
      if (r > wanted || !(r > 0) || (least && r >= *least)) return;
      least = r;
      push = (wanted - r) / r * away;
    });
    return push;
  }

  const Polygon& island_;
  double w_, area_;
  GrowthOptions options_;
  core::Random random_;
  core::BorderIndex border_;
  core::Lattice lattice_;
  Curve curve_;
  double spacing_ = 0;
  std::vector<std::uint32_t> seen_;  ///< per segment: the last look that met it
  std::uint32_t look_ = 0;
};

}  // namespace

Filling growth(const Polygon& island, double bead_width, const GrowthOptions& options) {
  return Growing(island, bead_width, options).run();
}

}  // namespace unicursal::bench
