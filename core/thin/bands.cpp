#include "core/thin/bands.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace unicursal::core {
namespace {

constexpr int disc_sides = 24;
constexpr double bend = 0.25;            ///< sine of a turn above which a line gets a disc
constexpr double cap_reach = 1.3;        ///< radii
constexpr double cap_box = 2.5;          ///< radii; half the side of the part of the border that is looked at
constexpr double arc_tolerance = 0.005;  ///< radii; of rounded offsets

Ring disc(const Vec2& centre, double radius) {
  Ring ring;
  for (int k = 0; k < disc_sides; ++k) {
    const double a = 2 * std::numbers::pi * k / disc_sides;
    ring.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
  }
  return ring;
}

}  // namespace

double length(const std::vector<BandPoint>& line) {
  double sum = 0;
  for (std::size_t k = 1; k < line.size(); ++k) sum += (line[k].position - line[k - 1].position).norm();
  return sum;
}

std::vector<BandPoint> shortened(const std::vector<BandPoint>& line, double most) {
  std::vector<BandPoint> result;
  if (!(most > 0)) return result;
  result.push_back(line.front());
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double step = (line[k].position - line[k - 1].position).norm();
    if (step >= most) {
      const double t = most / step;
      result.push_back({line[k - 1].position + t * (line[k].position - line[k - 1].position),
                        line[k - 1].radius + t * (line[k].radius - line[k - 1].radius),
                        line[k - 1].four && line[k].four});
      break;
    }
    result.push_back(line[k]);
    most -= step;
  }
  return result;
}

std::vector<BandPoint> without_crumbs(const std::vector<BandPoint>& line, double least) {
  std::vector<BandPoint> result;
  for (const BandPoint& p : line) {
    if (result.empty() || (p.position - result.back().position).norm() >= least) result.push_back(p);
  }
  if (line.size() < 2) return result;
  // The last point stays; the one before it gives way.
  if (result.size() > 1 && (result.back().position - line.back().position).norm() < least) result.pop_back();
  result.push_back(line.back());
  return result;
}

std::vector<Ring> band(const std::vector<BandPoint>& line, const std::vector<double>& halves, BandEnds ends) {
  std::vector<Ring> rings;
  const auto direction = [&](std::size_t k) {
    return Vec2((line[k + 1].position - line[k].position).normalized());
  };
  const std::size_t n = line.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (k == 0 || (k + 1 == n ? ends == BandEnds::round
                              : std::abs(cross(direction(k - 1), direction(k))) > bend ||
                                    direction(k - 1).dot(direction(k)) < 0))
      rings.push_back(disc(line[k].position, halves[k]));
  }
  // Each side of a piece is at right angles to the mean of the directions before and behind its end, so that
  // neighbours share it.
  std::vector<Vec2> across(n);
  for (std::size_t k = 0; k < n; ++k) {
    Vec2 mean(0, 0);
    if (k > 0) mean += direction(k - 1);
    if (k + 1 < n) mean += direction(k);
    if (mean.norm() < 0.5) mean = direction(k > 0 ? k - 1 : 0);
    across[k] = halves[k] * perpendicular(mean.normalized());
  }
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const Vec2 &a = line[k].position, &b = line[k + 1].position;
    Ring ring{a + across[k], a - across[k], b - across[k + 1], b + across[k + 1]};
    if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    rings.push_back(std::move(ring));
  }
  return rings;
}

Region cap(const Polygon& region, const Vec2& centre, double radius, double depth) {
  const double half = cap_box * radius, tolerance = arc_tolerance * radius;
  const Region local = intersect({region}, {{{centre + Vec2(-half, -half), centre + Vec2(half, -half),
                                              centre + Vec2(half, half), centre + Vec2(-half, half)},
                                             {}}});
  return intersect(offset(local, -depth, tolerance), {{disc(centre, cap_reach * radius), {}}});
}

}  // namespace unicursal::core
