#include "core/geometry/cell_integrals.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace unicursal::core {
namespace {

/// Gauss–Legendre on [0, 1], four points: exact for polynomials of degree 7.
constexpr std::array<double, 4> gauss_point{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                            0.93056815579702629};
constexpr std::array<double, 4> gauss_weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                             0.17392742256872693};

void add_integrals(CellIntegrals& sum, const CellIntegrals& more) {
  sum.area += more.area;
  sum.second_moment += more.second_moment;
}

}  // namespace

CellSums::CellSums(const CurveSites& sites, std::vector<std::size_t> vertices)
    : sites_(&sites),
      vertices_(std::move(vertices)),
      points_(vertices_.size()),
      segments_(vertices_.size()) {}

std::size_t CellSums::place(std::size_t vertex) const {
  const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
  return static_cast<std::size_t>(found - vertices_.begin());
}

bool CellSums::has(const CurveSite& site) const {
  const std::size_t k = place(site.index);
  return k < vertices_.size() && vertices_[k] == site.index;
}

void CellSums::add(const CurveSite& site, const Arc& arc, double s0, double s1, double weight) {
  CellIntegrals sum;
  const Vec2 origin = sites_->curve()[site.index];
  const Vec2 u = site.segment ? sites_->direction(site.index) : Vec2(0, 0);
  for (std::size_t g = 0; g < gauss_point.size(); ++g) {
    const double s = s0 + (s1 - s0) * gauss_point[g], step = gauss_weight[g] * (s1 - s0);
    const Vec2 p = arc.at(s) - origin, dp = arc.derivative(s);
    if (site.segment) {
      const double y = cross(u, p), dx = u.dot(dp);
      sum.area -= step * y * dx;
      sum.second_moment -= step * y * y * y / 3 * dx;
    } else {
      const double sweep = step * cross(p, dp);
      sum.area += sweep / 2;
      sum.second_moment += sweep * p.squaredNorm() / 4;
    }
  }
  CellIntegrals& cell = (site.segment ? segments_ : points_)[place(site.index)];
  cell.area += weight * sum.area;
  cell.second_moment += weight * sum.second_moment;
}

void CellSums::add_to(std::vector<CellIntegrals>& points, std::vector<CellIntegrals>& segments) const {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    add_integrals(points[vertices_[k]], points_[k]);
    add_integrals(segments[vertices_[k]], segments_[k]);
  }
}

}  // namespace unicursal::core
