#include "core/graph/seeds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/border_index.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double samples_per_distance = 5;      ///< lattice squares per d
constexpr double farthest_without_seed = 0.75;  ///< share of d
constexpr int relaxation_steps = 12;

std::vector<Vec2> triangular_tiling(const Polygon& domain, const SeedOptions& options, Random& random) {
  const double d = options.d;
  const Box box = bounds(domain);
  const double any = random.uniform(0, std::numbers::pi / 3), angle = options.rows.value_or(any);
  const double along = d * std::sqrt(options.stretch), across = d / std::sqrt(options.stretch);
  const Vec2 row(std::cos(angle), std::sin(angle));
  const Vec2 u = along * row, v = along / 2 * row + across * std::sqrt(3) / 2 * perpendicular(row);
  // The language leaves open which operand of a sum is computed first.
  const double share_of_v = random.uniform(), share_of_u = random.uniform();
  const Vec2 origin = box.center() + share_of_u * u + share_of_v * v;
  const double closest = std::min(along, across);
  const auto reach = static_cast<int>(std::ceil(box.size().norm() / closest / std::sqrt(3.0) * 1.2)) + 1;
  const BorderIndex border(domain, d);
  std::vector<Vec2> seeds;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const double radius = d / 20 * std::sqrt(random.uniform());
      const double turn = random.uniform(0, 2 * std::numbers::pi);
      const Vec2 p = origin + i * u + j * v + radius * Vec2(std::cos(turn), std::sin(turn));
      if (border.contains(p)) seeds.push_back(p);
    }
  }
  return seeds;
}

/// The heaviest sample inside the domain; the heaviest of all if none is inside.
Vec2 heaviest_sample(const Lattice& lattice, const BorderIndex& border) {
  std::size_t best = 0;
  bool best_inside = false;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const bool inside = lattice.weight(k) > 0 && border.contains(lattice.position(k));
    if (inside == best_inside ? lattice.weight(k) > lattice.weight(best) : inside) {
      best = k;
      best_inside = inside;
    }
  }
  return lattice.position(best);
}

/// Adds seeds where all seeds are too far away: visits the far samples in order of distance. A sample that
/// stands for the surroundings of a small hole may lie in the hole; it does not become a seed.
void fill_gaps(std::vector<Vec2>& seeds, const Lattice& lattice, LatticeOwners& owners,
               const BorderIndex& border, double d) {
  if (seeds.empty()) seeds.push_back(heaviest_sample(lattice, border));
  owners.assign(as_points(seeds));
  const double limit2 = std::pow(farthest_without_seed * d, 2);
  std::vector<std::size_t> far;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (lattice.weight(k) > 0 && owners.distance2(k) > limit2 && border.contains(lattice.position(k)))
      far.push_back(k);
  }
  std::sort(far.begin(), far.end(), [&](std::size_t a, std::size_t b) {
    return owners.distance2(a) != owners.distance2(b) ? owners.distance2(a) > owners.distance2(b) : a < b;
  });
  const std::size_t old = seeds.size();
  for (const std::size_t k : far) {
    const Vec2 p = lattice.position(k);
    const bool served = std::any_of(seeds.begin() + static_cast<std::ptrdiff_t>(old), seeds.end(),
                                    [&](const Vec2& s) { return (s - p).squaredNorm() < limit2; });
    if (!served) seeds.push_back(p);
  }
}

/// One step of Lloyd's method: moves every seed to the centroid of its samples.
void relax(std::vector<Vec2>& seeds, const Lattice& lattice, LatticeOwners& owners,
           const BorderIndex& border) {
  owners.assign(as_points(seeds));
  std::vector<double> mass(seeds.size(), 0);
  std::vector<Vec2> moment(seeds.size(), Vec2(0, 0));
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (owners.owner(k) < 0) continue;
    const std::int32_t s = owners.owner(k);
    mass[s] += lattice.weight(k);
    moment[s] += lattice.weight(k) * lattice.position(k);
  }
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    if (mass[s] <= 0) continue;
    const Vec2 centroid = moment[s] / mass[s];
    if (border.contains(centroid)) seeds[s] = centroid;
  }
}

}  // namespace

std::vector<Segment> as_points(const std::vector<Vec2>& seeds) {
  std::vector<Segment> points;
  points.reserve(seeds.size());
  for (const Vec2& seed : seeds) points.push_back({seed, seed});
  return points;
}

std::vector<Vec2> place_seeds(const Polygon& domain, const SeedOptions& options, Random& random) {
  const double d = options.d;
  const Box box = bounds(domain);
  const double finest = std::max(box.size().maxCoeff(), d) / 30000;
  const Lattice lattice = sample(domain, std::max(d / samples_per_distance, finest));
  if (lattice.size() == 0) return {domain.outer.front()};
  LatticeOwners owners(lattice);
  const BorderIndex border(domain, d);
  std::vector<Vec2> seeds = triangular_tiling(domain, options, random);
  fill_gaps(seeds, lattice, owners, border, d);
  for (int step = 0; step < relaxation_steps; ++step) {
    stop_point();
    relax(seeds, lattice, owners, border);
  }
  return seeds;
}

}  // namespace unicursal::core
