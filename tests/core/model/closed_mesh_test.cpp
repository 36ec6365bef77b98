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
  for (MeshEdge h = 0; h < mesh.twins.size(); ++h) {
    const MeshEdge twin = mesh.twins[h];
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
  CHECK_THAT(mesh.warnings[0], Contains("4 facets that faced the wrong way"));
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
  CHECK_THAT(result.warnings.at(0), Contains("1 shell was inside out"));
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
  CHECK_THAT(repaired(everything_inside_out).warnings.at(0), Contains("3 shells were inside out"));
}

TEST_CASE("a solid inside a solid that faces outwards is a solid, not a void") {
  const Repaired mesh = repaired(joined(cube_at(0), cube_at(2, 2, 2, 6)));
  CHECK(volume(mesh.mesh) == Approx(1000 + 216));
  CHECK(mesh.warnings.empty());
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
  CHECK_THAT(result.warnings.at(0), Contains("1 facet without area"));
}

TEST_CASE("a T-junction is stitched, whether or not a facet without area holds it together") {
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
  const Repaired stitched = repaired(mesh);
  check_twins(stitched.mesh);
  CHECK(volume(stitched.mesh) == Approx(1000));
  CHECK_THAT(stitched.warnings.at(0), Contains("stitched at 1 vertex"));
  mesh.push_back({a, b, m});
  CHECK(volume(repaired(mesh).mesh) == Approx(1000));
  CHECK(repaired(mesh).warnings.empty());
}

TEST_CASE("T-junctions on both sides of a seam are stitched") {
  // Two halves of a bar whose facing ends are left out; the seam has 3 vertices on one side and 4 on the
  // other.
  Mesh mesh;
  const auto half = [&](double x0, double x1, const std::vector<double>& cuts, bool seam_at_end) {
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double low = cuts[i], high = cuts[i + 1];
      add_quad(mesh, {x0, low, 0}, {x0, high, 0}, {x1, high, 0}, {x1, low, 0});
      add_quad(mesh, {x0, low, 4}, {x1, low, 4}, {x1, high, 4}, {x0, high, 4});
      const double x = seam_at_end ? x0 : x1;
      if (seam_at_end) add_quad(mesh, {x, low, 0}, {x, low, 4}, {x, high, 4}, {x, high, 0});
      if (!seam_at_end) add_quad(mesh, {x, low, 0}, {x, high, 0}, {x, high, 4}, {x, low, 4});
    }
    const double low = cuts.front(), high = cuts.back();
    add_quad(mesh, {x0, low, 0}, {x1, low, 0}, {x1, low, 4}, {x0, low, 4});
    add_quad(mesh, {x0, high, 0}, {x0, high, 4}, {x1, high, 4}, {x1, high, 0});
  };
  half(0, 10, {0, 5, 10}, true);
  half(10, 20, {0, 3, 6, 10}, false);
  const Repaired result = repaired(mesh);
  check_twins(result.mesh);
  CHECK(volume(result.mesh) == Approx(20 * 10 * 4));
  CHECK_THAT(result.warnings.at(0), Contains("stitched"));
}

TEST_CASE("a flat hole is closed, and the note says where and how large it is") {
  Mesh mesh = cube_at(0);
  mesh.pop_back();
  const Repaired triangle = repaired(mesh);
  check_twins(triangle.mesh);
  CHECK(volume(triangle.mesh) == Approx(1000));
  CHECK_THAT(triangle.warnings.at(0), Contains("1 hole was closed, the largest of 50 mm² near (10,"));
  mesh.pop_back();
  CHECK(volume(repaired(mesh).mesh) == Approx(1000));
  Mesh tube = torus_mesh(10, 3, 48, 24);  // without a slice: its ends are flat circles
  tube.erase(tube.begin(), tube.begin() + 2 * 24);
  const Repaired cut = repaired(tube);
  CHECK_THAT(cut.warnings.at(0), Contains("2 holes were closed"));
  CHECK(volume(cut.mesh) == Approx(volume(repaired(torus_mesh(10, 3, 48, 24)).mesh) * 47 / 48).epsilon(1e-3));
}

TEST_CASE("a hole whose border is not flat is refused with its place, since closing it is a guess") {
  Mesh mesh = torus_mesh(10, 3, 24, 12);
  mesh.erase(mesh.begin() + 100, mesh.begin() + 190);
  CHECK_THAT(refusal(mesh), Contains("open") && Contains("would be a guess") && Contains("near ("));
}

TEST_CASE("a small hole in a curved surface is closed") {
  Mesh mesh = torus_mesh(10, 3, 96, 48);
  const double sound = volume(repaired(mesh).mesh);
  mesh.erase(mesh.begin() + 100, mesh.begin() + 102);
  CHECK(volume(repaired(mesh).mesh) == Approx(sound).epsilon(1e-3));
}

TEST_CASE("a surface without thickness encloses nothing") {
  Mesh sheet;
  add_quad(sheet, {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  CHECK_THAT(refusal(sheet), Contains("encloses no volume"));
  Mesh beside = cube_at(20);
  add_quad(beside, {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  const Repaired result = repaired(beside);
  CHECK(volume(result.mesh) == Approx(1000));
  CHECK_THAT(result.warnings.back(), Contains("100 mm² without thickness"));
}

TEST_CASE("a fin on a solid adds nothing") {
  Mesh mesh = cube_at(0);
  mesh.push_back({Vec3(10, 0, 0), Vec3(10, 0, 10), Vec3(20, 5, 5)});
  const Repaired result = repaired(mesh);
  check_twins(result.mesh);
  CHECK(volume(result.mesh) == Approx(1000));
}

TEST_CASE("copies of facets are left out where they open the surface, and kept where they do not") {
  Mesh mesh = cube_at(0);
  mesh.push_back(mesh[4]);
  const Repaired one = repaired(mesh);
  CHECK(one.mesh.facets.size() == 12);
  CHECK_THAT(one.warnings.at(0), Contains("1 copy of a facet"));
  // Two solids that share a side, both on the same side of it.
  const Repaired two = repaired(joined(box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({0, 0, 0}, {4, 10, 10})));
  check_twins(two.mesh);
  CHECK(two.warnings.empty());
}

TEST_CASE("a surface with only one side is refused") {
  // A Klein bottle: a tube whose end is joined to its start the other way round.
  constexpr int around = 12, along = 12;
  const auto vertex = [](int i, int j) {
    if (i == along) return std::pair(0, (2 * around - 1 - j) % around);
    return std::pair(i, j % around);
  };
  const auto p = [&](int i, int j) {
    const auto [u, v] = vertex(i, j);
    const double a = 2 * std::numbers::pi * u / along, b = 2 * std::numbers::pi * (v + 0.5) / around;
    const double r = 20 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
    return Vec3(r * std::cos(a), r * std::sin(a),
                std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
  };
  Mesh mesh;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) add_quad(mesh, p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1));
  }
  CHECK_THAT(refusal(mesh), Contains("one side"));
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

TEST_CASE("a body that is present twice is a closed surface") {
  check_twins(repaired(joined(cube_at(0), cube_at(0))).mesh);
}
