#include "core/model/largest_face.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace unicursal::core {
namespace {

using HullPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Hull = CGAL::Surface_mesh<HullPoint>;

constexpr double same_face = 0.5 * std::numbers::pi / 180;  ///< between normals of facets of one face

/// Each facet's normal, as long as the facet is large (twice its area).
std::vector<Vec3> normals_of(const Hull& hull) {
  std::vector<Vec3> result;
  for (const auto facet : hull.faces()) {
    const auto h = hull.halfedge(facet);
    const auto corner = [&](auto half_edge) {
      const auto& p = hull.point(hull.target(half_edge));
      return Vec3(p.x(), p.y(), p.z());
    };
    const Vec3 a = corner(h), b = corner(hull.next(h)), c = corner(hull.next(hull.next(h)));
    result.push_back((b - a).cross(c - a));
  }
  return result;
}

}  // namespace

Eigen::Matrix3d largest_face_down(const std::vector<Vec3>& points) {
  std::vector<HullPoint> cloud;
  cloud.reserve(points.size());
  for (const Vec3& p : points) cloud.emplace_back(p.x(), p.y(), p.z());
  Hull hull;
  CGAL::convex_hull_3(cloud.begin(), cloud.end(), hull);
  std::vector<Vec3> normals = normals_of(hull);
  std::erase_if(normals, [](const Vec3& n) { return n.norm() == 0; });
  // Large facets first: each takes the smaller ones that face the same way.
  std::stable_sort(normals.begin(), normals.end(),
                   [](const Vec3& a, const Vec3& b) { return a.squaredNorm() > b.squaredNorm(); });
  std::vector<std::pair<Vec3, double>> faces;  // the direction of the first facet, twice the area
  constexpr std::size_t most_faces = 1000;     // smaller ones cannot be the largest
  for (const Vec3& normal : normals) {
    const double size = normal.norm();
    const Vec3 direction = normal / size;
    const auto known = std::find_if(faces.begin(), faces.end(), [&](const auto& face) {
      return face.first.cross(direction).norm() < std::sin(same_face) && face.first.dot(direction) > 0;
    });
    if (known != faces.end()) {
      known->second += size;
    } else if (faces.size() < most_faces) {
      faces.emplace_back(direction, size);
    }
  }
  constexpr std::size_t fewest_faces = 4;  // of a solid
  if (faces.size() < fewest_faces) return Eigen::Matrix3d::Identity();
  // Among faces of the same size the one that is down already is taken, or needs the smallest turn.
  const double largest = std::max_element(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                         })->second;
  const Vec3 down = -Vec3::UnitZ();
  const auto turn_of = [&](const auto& face) {
    constexpr double same_size = 1 - 1e-6;
    return face.second < same_size * largest ? -2.0 : face.first.dot(down);
  };
  const Vec3 chosen = std::max_element(faces.begin(), faces.end(), [&](const auto& a, const auto& b) {
                        return turn_of(a) < turn_of(b);
                      })->first;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(chosen, down).toRotationMatrix();
  // Quarter turns are exact, so that flat sides stay flat.
  return turn.unaryExpr([](double x) { return std::abs(x - std::round(x)) < 1e-12 ? std::round(x) : x; });
}

}  // namespace unicursal::core
