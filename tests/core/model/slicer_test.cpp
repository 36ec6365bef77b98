#include "core/model/slicer.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>
#include <iterator>
#include <list>
#include <random>

#include "core/geometry/region.hpp"
#include "core/model/closed_mesh.hpp"
#include "model_support.hpp"

using namespace unicursal::core;

namespace {

ClosedMesh closed(const Mesh& mesh) {
  Warnings warnings;
  return closed_mesh(mesh, "test.stl", warnings);
}

double section_area(const Slicer& slicer, double z) {
  return area(enclosed(slicer.contours(z), FillRule::non_zero));
}

/// The same section by CGAL's slicer.
double cgal_section_area(const ClosedMesh& mesh, double z) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Vec3& v : mesh.vertices) vertices.push_back(surface.add_vertex({v.x(), v.y(), v.z()}));
  for (const auto& [a, b, c] : mesh.facets) surface.add_face(vertices[a], vertices[b], vertices[c]);
  std::list<std::vector<Kernel::Point_3>> lines;
  CGAL::Polygon_mesh_slicer<Surface, Kernel> slicer(surface);
  slicer(Kernel::Plane_3(0, 0, 1, -z), std::back_inserter(lines));
  std::vector<Ring> rings;
  for (const auto& line : lines) {
    if (line.size() < 4 || line.front() != line.back()) continue;
    Ring ring;
    for (const auto& p : line) ring.emplace_back(p.x(), p.y());
    ring.pop_back();
    rings.push_back(ring);
  }
  return area(enclosed(rings, FillRule::even_odd));
}

}  // namespace

TEST_CASE("contours have the solid to their left") {
  const Slicer torus(closed(torus_mesh(10, 3, 48, 24)));
  const auto contours = torus.contours(0.1);
  REQUIRE(contours.size() == 2);
  CHECK(signed_area(contours[0]) * signed_area(contours[1]) < 0);
  CHECK(signed_area(contours[0]) + signed_area(contours[1]) > 0);
}

TEST_CASE("planes through vertices, edges and faces cut like planes just above") {
  const Slicer cube(closed(box_mesh({0, 0, 0}, {10, 10, 10})));
  CHECK(section_area(cube, 0) == Approx(100));
  CHECK(section_area(cube, 5) == Approx(100));
  CHECK(section_area(cube, 10) == 0);
  CHECK(section_area(cube, -1) == 0);
  // Two vertex rings of this torus lie exactly at z = 0.
  const Slicer torus(closed(torus_mesh(10, 3, 48, 24)));
  CHECK(section_area(torus, 0) == Approx(section_area(torus, 1e-9)).epsilon(1e-6));
}

TEST_CASE("a staircase of coplanar steps is cut at every step's own height") {
  Mesh stairs;
  for (int i = 0; i < 5; ++i)
    stairs = joined(stairs, box_mesh({10.0 * i, 0, 0}, {10.0 * (i + 1), 10, 5.0 - i}));
  const Slicer slicer(closed(stairs));
  for (int i = 0; i < 5; ++i) CHECK(section_area(slicer, i) == Approx(100 * (5 - i)));
}

TEST_CASE("sections agree with CGAL's slicer at any height") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> height(-2.99, 2.99), wobble(-0.3, 0.3);
  Mesh mesh = torus_mesh(10, 3, 40, 20);
  for (Triangle& triangle : mesh) {
    // A bumpy torus: the same shift for the same corner, since it depends on its place only.
    for (Vec3& p : triangle) p += 0.3 * Vec3(std::sin(3 * p.y()), std::cos(2 * p.z()), std::sin(p.x()));
  }
  const Slicer slicer(closed(mesh));
  for (int i = 0; i < 40; ++i) {
    const double z = height(random);
    CAPTURE(z);
    CHECK(section_area(slicer, z) == Approx(cgal_section_area(slicer.mesh(), z)).epsilon(1e-6).margin(1e-6));
  }
}

TEST_CASE("the sections of a solid add up to its volume") {
  const Slicer torus(closed(torus_mesh(10, 3, 96, 96)));
  double volume = 0;
  for (int i = 0; i < 600; ++i) volume += 0.01 * section_area(torus, -3 + 0.01 * (i + 0.5));
  CHECK(volume == Approx(2 * std::numbers::pi * std::numbers::pi * 10 * 9).epsilon(3e-3));
}

TEST_CASE("the height index finds what a search of everything finds") {
  std::mt19937 random(23);
  for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 64u, 500u}) {
    std::vector<HeightSpan> spans;
    for (std::size_t i = 0; i < n; ++i) {
      const double low = double(random() % 50);
      spans.push_back({low, low + double(random() % 10)});
    }
    const HeightIndex index(spans);
    for (double z = -1; z < 62; z += 0.5) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < n; ++i) {
        if (spans[i].low <= z && z < spans[i].high) expected.push_back(i);
      }
      REQUIRE(index.at(z) == expected);
    }
  }
}
