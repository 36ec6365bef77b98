#include "core/model/closed_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "core/error.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

struct Repaired {
  ClosedMesh mesh;
  std::vector<std::string> warnings;
};

Repaired repaired(const Mesh& triangles) {
  Warnings warnings;
  Repaired result{closed_mesh(triangles, "test.stl", warnings), {}};
  result.warnings = warnings.sentences();
  return result;
}

std::string refusal(const Mesh& triangles) {
  try {
    repaired(triangles);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

double volume(const ClosedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.facets) {
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  }
  return sum;
}

void check_twins(const ClosedMesh& mesh) {
  for (HalfEdge h = 0; h < mesh.twins.size(); ++h) {
    const HalfEdge twin = mesh.twins[h];
    REQUIRE(twin != h);
    REQUIRE(mesh.twins[twin] == h);
    REQUIRE(mesh.from(h) == mesh.to(twin));
    REQUIRE(mesh.to(h) == mesh.from(twin));
  }
}

Mesh cube_at(double x, double y = 0, double z = 0, double size = 10) {
  return box_mesh({x, y, z}, {x + size, y + size, z + size});
}

void turn_all_over(Mesh& mesh) {
  for (Triangle& triangle : mesh) turn_over(triangle);
}

}  // namespace

TEST_CASE("a sound mesh is not changed") {
  const Repaired cube = repaired(cube_at(0));
  CHECK(cube.mesh.vertices.size() == 8);
  CHECK(cube.warnings.empty());
  CHECK(volume(cube.mesh) == Approx(1000));
  check_twins(cube.mesh);
}

TEST_CASE("facets that face the wrong way are turned and counted") {
  Mesh torus = torus_mesh(10, 3, 24, 12);
  const double sound = volume(repaired(torus).mesh);
  for (const std::size_t i : {0u, 5u, 6u, 100u}) turn_over(torus[i]);
  const Repaired mesh = repaired(torus);
  check_twins(mesh.mesh);
  CHECK(volume(mesh.mesh) == Approx(sound));
  REQUIRE(mesh.warnings.size() == 1);
  CHECK_THAT(mesh.warnings[0], Contains("4 facets faced the wrong way"));
}

TEST_CASE("facets in random order and orientation still bound the volume") {
  std::mt19937 random(3);
  Mesh mesh = joined(cube_at(0), torus_mesh(30, 3, 16, 8));
  const double sound = volume(repaired(mesh).mesh);
  std::shuffle(mesh.begin(), mesh.end(), random);
  for (Triangle& triangle : mesh) {
    if (random() % 2) turn_over(triangle);
  }
  CHECK(volume(repaired(mesh).mesh) == Approx(sound));
}

TEST_CASE("a mesh inside out is turned as a whole") {
  Mesh mesh = cube_at(0);
  turn_all_over(mesh);
  const Repaired result = repaired(mesh);
  CHECK(volume(result.mesh) == Approx(1000));
  CHECK_THAT(result.warnings.at(0), Contains("1 shells were inside out"));
}

TEST_CASE("cavities stay cavities, and solids inside them stay solid") {
  Mesh cavity = cube_at(2, 2, 2, 6);
  turn_all_over(cavity);
  const Mesh kernel = cube_at(4, 4, 4, 2);
  const Mesh nested = joined(joined(cube_at(0), cavity), kernel);
  CHECK(repaired(nested).warnings.empty());
  CHECK(volume(repaired(nested).mesh) == Approx(1000 - 216 + 8));
  Mesh everything_inside_out = nested;
  turn_all_over(everything_inside_out);
  CHECK(volume(repaired(everything_inside_out).mesh) == Approx(1000 - 216 + 8));
}

TEST_CASE("solids that overlap without nesting both stay solid") {
  const Repaired mesh = repaired(joined(cube_at(0), cube_at(5, 1, 1)));
  CHECK(volume(mesh.mesh) == Approx(2000));
  CHECK(mesh.warnings.empty());
}

TEST_CASE("vertices that nearly coincide are welded") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-2e-5, 2e-5);
  Mesh mesh = torus_mesh(10, 3, 24, 12);
  const double sound = volume(repaired(mesh).mesh);
  for (Triangle& triangle : mesh) {
    for (Vec3& corner : triangle) corner += Vec3(noise(random), noise(random), noise(random));
  }
  const Repaired result = repaired(mesh);
  check_twins(result.mesh);
  CHECK(volume(result.mesh) == Approx(sound).epsilon(1e-4));
}

TEST_CASE("facets without area are dropped and counted") {
  Mesh mesh = cube_at(0);
  mesh.push_back({Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(10, 0, 0)});
  const Repaired result = repaired(mesh);
  CHECK(result.mesh.facets.size() == 12);
  CHECK_THAT(result.warnings.at(0), Contains("1 facets without area"));
}

TEST_CASE("a facet without area that holds the mesh together is kept") {
  // One side of the cube's top is split at its middle on one face only; a flat facet fills the slit.
  Mesh mesh = cube_at(0);
  const Vec3 a(0, 0, 10), b(10, 0, 10), m(5, 0, 10);
  const auto on_top = [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [](const Vec3& p) { return p.z() == 10; }) &&
           std::count(t.begin(), t.end(), a) == 1 && std::count(t.begin(), t.end(), b) == 1;
  };
  const auto top = std::find_if(mesh.begin(), mesh.end(), on_top);
  REQUIRE(top != mesh.end());
  const Vec3 c = *std::find_if(top->begin(), top->end(), [&](const Vec3& p) { return p != a && p != b; });
  mesh.erase(top);
  mesh.push_back({a, m, c});
  mesh.push_back({m, b, c});
  CHECK_THAT(refusal(mesh), Contains("open"));
  mesh.push_back({a, b, m});
  CHECK(volume(repaired(mesh).mesh) == Approx(1000));
}

TEST_CASE("open meshes are refused with an edge and a count") {
  Mesh mesh = cube_at(0);
  mesh.pop_back();
  CHECK_THAT(refusal(mesh), Contains("open") && Contains("3 edges") && Contains("the edge from (10.0000"));
}

TEST_CASE("edges with three facets are refused") {
  Mesh mesh = cube_at(0);
  const Vec3 outside(20, 5, 5);
  mesh.push_back({Vec3(10, 0, 0), Vec3(10, 0, 10), outside});
  CHECK_FALSE(refusal(mesh).empty());
}

TEST_CASE("a surface with only one side is refused") {
  // A Klein bottle: a tube whose end is joined to its start the other way round.
  constexpr int around = 12, along = 12;
  const auto vertex = [](int i, int j) {
    if (i == along) return std::pair(0, (around - j) % around);
    return std::pair(i, j % around);
  };
  const auto p = [&](int i, int j) {
    const auto [u, v] = vertex(i, j);
    const double a = 2 * std::numbers::pi * u / along, b = 2 * std::numbers::pi * v / around;
    const double r = 20 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
    return Vec3(r * std::cos(a), r * std::sin(a),
                std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
  };
  Mesh mesh;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) add_quad(mesh, p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1));
  }
  CHECK_THAT(refusal(mesh), Contains("one side") || Contains("without bounding a solid"));
}

TEST_CASE("solids in contact along a face or an edge are both kept") {
  const Repaired face = repaired(joined(cube_at(0), cube_at(10)));
  check_twins(face.mesh);
  CHECK(volume(face.mesh) == Approx(2000));
  const Repaired edge = repaired(joined(cube_at(0), cube_at(10, 10)));
  check_twins(edge.mesh);
  CHECK(volume(edge.mesh) == Approx(2000));
  const Repaired corner = repaired(joined(cube_at(0), cube_at(10, 10, 10)));
  CHECK(volume(corner.mesh) == Approx(2000));
}

TEST_CASE("a contact face may be cut along either diagonal") {
  // Mirrored in y the second cube's facets use the other diagonals.
  Mesh mirrored = cube_at(10, -10);
  for (Triangle& triangle : mirrored) {
    for (Vec3& corner : triangle) corner.y() = -corner.y();
    turn_over(triangle);
  }
  const Repaired result = repaired(joined(cube_at(0), mirrored));
  check_twins(result.mesh);
  CHECK(volume(result.mesh) == Approx(2000));
}

TEST_CASE("a body that is present twice counts once") {
  CHECK(volume(repaired(joined(cube_at(0), cube_at(0))).mesh) == Approx(1000));
}
