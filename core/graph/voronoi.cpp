#include "core/graph/voronoi.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace unicursal::core {
namespace {

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<CellIndex, PlaneKernel>;
using Face = CGAL::Triangulation_face_base_with_info_2<VoronoiVertexIndex, PlaneKernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<PlaneKernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;

constexpr int far_sites = 16;
constexpr double far_radius = 5;  ///< box diagonals from the centre

}  // namespace

Voronoi voronoi(const std::vector<Vec2>& sites, const Box& box) {
  std::vector<std::pair<PlaneKernel::Point_2, CellIndex>> points;
  points.reserve(sites.size() + far_sites);
  const auto add = [&](double x, double y) {
    points.emplace_back(PlaneKernel::Point_2(x, y), CellIndex(points.size()));
  };
  for (const Vec2& site : sites) add(site.x(), site.y());
  const double radius = far_radius * (box.size().norm() + 1);
  for (int k = 0; k < far_sites; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.3) / far_sites;
    add(box.center().x() + radius * std::cos(turn), box.center().y() + radius * std::sin(turn));
  }
  // CGAL shuffles what it inserts; the order must not depend on earlier work.
  CGAL::get_default_random() = CGAL::Random(0);
  const Delaunay triangulation(points.begin(), points.end());

  Voronoi result;
  for (const auto face : triangulation.all_face_handles()) face->info() = {};
  for (const auto face : triangulation.finite_face_handles()) {
    const PlaneKernel::Point_2 c = triangulation.circumcenter(face);
    face->info() = result.vertices.push_back({Vec2(c.x(), c.y()), {}});
  }
  for (const auto face : triangulation.finite_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      const auto other = face->neighbor(i);
      if (other->info() < face->info()) continue;
      const CellIndex left = face->vertex(Delaunay::cw(i))->info();
      const CellIndex right = face->vertex(Delaunay::ccw(i))->info();
      const VoronoiEdgeIndex edge = result.edges.push_back({face->info(), other->info(), left, right, {}});
      result.vertices[face->info()].edges[i] = edge;
      result.vertices[other->info()].edges[other->index(face)] = edge;
    }
  }
  return result;
}

}  // namespace unicursal::core
