#include "core/graph/voronoi.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace unicursal::core {
namespace {

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<CellIndex, PlaneKernel>;
using Face = CGAL::Triangulation_face_base_with_info_2<VoronoiVertexIndex, PlaneKernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<PlaneKernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;

constexpr int far_sites = 16;
constexpr double far_radius = 5;  ///< box diagonals from the centre
constexpr std::uint32_t curve_cells =
    1024;  ///< along each side of the box, on the curve that orders vertices

/// The bits of a number below 2¹⁶, each followed by a zero.
std::uint32_t spaced(std::uint32_t bits) {
  bits = (bits | (bits << 8)) & 0x00FF00FFU;
  bits = (bits | (bits << 4)) & 0x0F0F0F0FU;
  bits = (bits | (bits << 2)) & 0x33333333U;
  return (bits | (bits << 1)) & 0x55555555U;
}

/// The place of a point on a curve that passes through the box in the order of ever smaller squares
/// (Morton's).
std::uint32_t place_on_curve(double x, double y, const Box& box) {
  const auto cell = [](double at, double low, double size) {
    const double share = size > 0 ? std::clamp((at - low) / size, 0.0, 1.0) : 0.0;
    return std::min(static_cast<std::uint32_t>(share * curve_cells), curve_cells - 1);
  };
  return spaced(cell(x, box.min.x(), box.size().x())) | (spaced(cell(y, box.min.y(), box.size().y())) << 1);
}

/// The triangles in an order in which neighbours mostly follow each other. Nodes, edges and cells are
/// numbered in that order, so that the optimiser finds what it needs together in memory.
std::vector<std::pair<std::uint32_t, Delaunay::Face_handle>> in_order(const Delaunay& triangulation,
                                                                      const Box& box) {
  std::vector<std::pair<std::uint32_t, Delaunay::Face_handle>> faces;
  for (const auto face : triangulation.finite_face_handles()) {
    const PlaneKernel::Point_2& p = face->vertex(0)->point();
    faces.emplace_back(place_on_curve(p.x(), p.y(), box), face);
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto& l, const auto& r) { return l.first < r.first; });
  return faces;
}

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
  std::vector<Delaunay::Face_handle> faces;
  for (const auto face : triangulation.all_face_handles()) face->info() = {};
  for (const auto& [place, face] : in_order(triangulation, box)) {
    const PlaneKernel::Point_2 c = triangulation.circumcenter(face);
    face->info() = result.vertices.push_back({Vec2(c.x(), c.y()), {}});
    faces.push_back(face);
  }
  for (const auto face : faces) {
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
