#include "core/model/hole.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

namespace unicursal::core {
namespace {

constexpr std::size_t most_triangulated = 300;  ///< edges of a loop; the time grows with their cube at worst

using Loop = std::vector<std::uint32_t>;
using Corner = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// The borders run backwards and taken apart into loops that pass no vertex twice.
std::vector<Loop> loops_along(const ClosedMesh& mesh, const std::vector<MeshEdge>& borders) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> ways;
  for (auto h = borders.rbegin(); h != borders.rend(); ++h) ways[mesh.to(*h)].push_back(mesh.from(*h));
  std::vector<Loop> loops;
  Loop path;
  std::map<std::uint32_t, std::size_t> on_path;
  for (auto& [start, first_ways] : ways) {
    std::uint32_t at = start;
    while (true) {
      if (const auto met = on_path.find(at); met != on_path.end()) {
        Loop loop(path.begin() + std::ptrdiff_t(met->second), path.end());
        path.resize(met->second);
        for (const auto v : loop) on_path.erase(v);
        if (loop.size() >= 3) loops.push_back(std::move(loop));
      }
      auto& onward = ways.at(at);
      if (onward.empty())
        break;  // only at the start, when the walk is back and all ways from here have been gone
      on_path[at] = path.size();
      path.push_back(at);
      at = onward.back();
      onward.pop_back();
    }
  }
  return loops;
}

Vec3 middle_of(const ClosedMesh& mesh, const Loop& loop) {
  Vec3 sum(0, 0, 0);
  for (const auto v : loop) sum += mesh.vertices[v];
  return sum / double(loop.size());
}

/// Twice the area that the loop's shadow has at most, along the direction in which it has it.
Vec3 double_area(const ClosedMesh& mesh, const Loop& loop, const Vec3& middle) {
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += (mesh.vertices[loop[i]] - middle).cross(mesh.vertices[loop[(i + 1) % loop.size()]] - middle);
  }
  return sum;
}

double area_of(const ClosedMesh& mesh, const std::array<std::uint32_t, 3>& f) {
  return (mesh.vertices[f[1]] - mesh.vertices[f[0]]).cross(mesh.vertices[f[2]] - mesh.vertices[f[0]]).norm() /
         2;
}

using Facets = std::vector<std::array<std::uint32_t, 3>>;

/// Empty if CGAL finds no triangulation.
Facets triangulated(const ClosedMesh& mesh, const Loop& loop) {
  if (loop.size() == 3) return {{loop[0], loop[1], loop[2]}};
  std::vector<Corner> points;
  for (const auto v : loop) {
    const Vec3& p = mesh.vertices[v];
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(found));
  Facets facets;
  for (const auto& t : found) {
    facets.push_back({loop[std::size_t(t.first)], loop[std::size_t(t.second)], loop[std::size_t(t.third)]});
  }
  return facets;
}

Facets fan(ClosedMesh& mesh, const Loop& loop, const Vec3& middle) {
  const auto hub = std::uint32_t(mesh.vertices.size());
  mesh.vertices.push_back(middle);
  Facets facets;
  for (std::size_t i = 0; i < loop.size(); ++i) facets.push_back({loop[i], loop[(i + 1) % loop.size()], hub});
  return facets;
}

Hole fill(ClosedMesh& mesh, const Loop& loop) {
  Hole hole;
  hole.edges = loop.size();
  hole.place = middle_of(mesh, loop);
  Facets facets;
  if (loop.size() <= most_triangulated) facets = triangulated(mesh, loop);
  if (facets.empty()) facets = fan(mesh, loop, hole.place);
  for (const auto& f : facets) hole.area += area_of(mesh, f);
  const Vec3 normal = double_area(mesh, loop, hole.place).normalized();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto v : loop) {
    const double height = normal.dot(mesh.vertices[v] - hole.place);
    low = std::min(low, height), high = std::max(high, height);
  }
  hole.doubt = hole.area * (high - low) / 2;
  mesh.facets.insert(mesh.facets.end(), facets.begin(), facets.end());
  mesh.sources.resize(mesh.facets.size(), no_source);
  return hole;
}

}  // namespace

std::vector<Hole> fill_holes(ClosedMesh& mesh, const std::vector<MeshEdge>& borders) {
  std::vector<Hole> holes;
  for (const Loop& loop : loops_along(mesh, borders)) holes.push_back(fill(mesh, loop));
  return holes;
}

}  // namespace unicursal::core
