#include "core/model/painted_shell.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/model/edge_pairing.hpp"

namespace unicursal::core {
namespace {

constexpr double longest_mitre = 2;  ///< in depths: how far a vertex at a sharp edge may move
constexpr double clearance = 1e-3;   ///< mm: hits nearer than this are the surface itself

using Cartesian = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Cartesian::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Cartesian, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Cartesian, Primitive>>;

Cartesian::Point_3 point(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Where each vertex moves to.
class Inset {
 public:
  Inset(const ClosedMesh& mesh, double depth)
      : mesh_(mesh), depth_(depth), directions_(mesh.vertices.size(), Vec3(0, 0, 0)) {
    for (const auto& f : mesh.facets) {
      const Cartesian::Triangle_3 triangle(point(mesh.vertices[f[0]]), point(mesh.vertices[f[1]]),
                                           point(mesh.vertices[f[2]]));
      // One without area stops no ray, and CGAL must not be asked whether it does.
      if (!triangle.is_degenerate()) triangles_.push_back(triangle);
      for (std::size_t k = 0; k < 3; ++k) directions_[f[k]] += angle(f, k) * normal(f);
    }
    for (Vec3& direction : directions_) direction.normalize();
    mitres_.assign(mesh.vertices.size(), 1);
    for (const auto& f : mesh.facets) {
      for (const auto v : f) mitres_[v] = std::min(mitres_[v], std::abs(normal(f).dot(directions_[v])));
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  Vec3 moved(std::uint32_t v) const {
    const Vec3& direction = directions_[v];
    const Vec3& from = mesh_.vertices[v];
    if (!(direction.squaredNorm() > 0.5)) return from;
    const double way = depth_ / std::max(mitres_[v], 1 / longest_mitre);
    return from - std::min(way, distance_across(from, -direction) / 2) * direction;
  }

 private:
  using Facet = std::array<std::uint32_t, 3>;

  Vec3 normal(const Facet& f) const {
    const Vec3 n =
        (mesh_.vertices[f[1]] - mesh_.vertices[f[0]]).cross(mesh_.vertices[f[2]] - mesh_.vertices[f[0]]);
    const double length = n.norm();
    return length > 0 ? Vec3(n / length) : Vec3(0, 0, 0);
  }

  double angle(const Facet& f, std::size_t k) const {
    const Vec3 a = mesh_.vertices[f[(k + 1) % 3]] - mesh_.vertices[f[k]];
    const Vec3 b = mesh_.vertices[f[(k + 2) % 3]] - mesh_.vertices[f[k]];
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  /// To the opposite side of the solid, mm.
  double distance_across(const Vec3& from, const Vec3& direction) const {
    const Vec3 start = from + clearance * direction;
    const Cartesian::Ray_3 ray(point(start),
                               Cartesian::Vector_3(direction.x(), direction.y(), direction.z()));
    const auto hit = tree_.first_intersection(ray);
    if (!hit) return std::numeric_limits<double>::infinity();
    const auto* const at = boost::get<Cartesian::Point_3>(&hit->first);
    if (!at) return std::numeric_limits<double>::infinity();  // along a facet
    return (Vec3(at->x(), at->y(), at->z()) - from).norm();
  }

  const ClosedMesh& mesh_;
  double depth_;
  std::vector<Vec3> directions_;  ///< outwards
  std::vector<double> mitres_;    ///< the least cosine between the direction and a normal
  Triangles triangles_;
  Tree tree_;
};

/// A piece of a painted facet, and where it moves to.
struct Patch {
  Triangle outer, inner;
};

Triangle mapped(const Triangle& barycentric, const Triangle& to) {
  Triangle result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = barycentric[k][0] * to[0] + barycentric[k][1] * to[1] + barycentric[k][2] * to[2];
  return result;
}

double share(const Triangle& barycentric) {
  return (barycentric[1] - barycentric[0]).cross(barycentric[2] - barycentric[0]).norm() / std::sqrt(3.0);
}

/// Swaps two corners of a facet that was turned.
Triangle turned(Triangle t) {
  std::swap(t[1], t[2]);
  return t;
}

class Painter {
 public:
  Painter(const MeshBody& body, const ClosedMesh& mesh, double depth)
      : body_(body), mesh_(mesh), inset_(mesh, depth), patches_(body.paints.size()) {
    for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
      if (mesh.sources[f] != no_source) facets_of_[mesh.sources[f]].push_back(f);
    }
    for (auto piece = body.painted.begin(); piece != body.painted.end();) {
      const auto end = std::find_if(piece, body.painted.end(), [&](const PaintedPiece& other) {
        return other.triangle != piece->triangle;
      });
      paint(std::vector<PaintedPiece>(piece, end));
      piece = end;
    }
  }

  const std::vector<Patch>& patches(std::size_t tint) const { return patches_[tint]; }

 private:
  Triangle outer(std::uint32_t f) const {
    const auto& [a, b, c] = mesh_.facets[f];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }
  Triangle inner(std::uint32_t f) {
    Triangle result;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh_.facets[f][k];
      auto known = moved_.find(v);
      if (known == moved_.end()) known = moved_.emplace(v, inset_.moved(v)).first;
      result[k] = known->second;
    }
    return result;
  }

  /// All painted pieces of one triangle.
  void paint(const std::vector<PaintedPiece>& pieces) {
    const auto found = facets_of_.find(pieces.front().triangle);
    if (found == facets_of_.end()) return;
    const Triangle& source = body_.triangles[pieces.front().triangle];
    if (found->second.size() > 1) return paint_whole(pieces, found->second);
    const std::uint32_t f = found->second.front();
    const Triangle out = outer(f), in = inner(f);
    const bool was_turned = (out[1] - source[1]).norm() > (out[2] - source[1]).norm();
    for (const PaintedPiece& piece : pieces) {
      Patch patch{was_turned ? turned(mapped(piece.corners, turned(out))) : mapped(piece.corners, out),
                  was_turned ? turned(mapped(piece.corners, turned(in))) : mapped(piece.corners, in)};
      patches_[piece.tint].push_back(std::move(patch));
    }
  }

  void paint_whole(const std::vector<PaintedPiece>& pieces, const std::vector<std::uint32_t>& facets) {
    std::map<std::uint32_t, double> shares;
    double bare = 1;
    for (const PaintedPiece& piece : pieces)
      shares[piece.tint] += share(piece.corners), bare -= share(piece.corners);
    const auto most = std::max_element(shares.begin(), shares.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most->second < bare) return;
    for (const auto f : facets) patches_[most->first].push_back({outer(f), inner(f)});
  }

  const MeshBody& body_;
  const ClosedMesh& mesh_;
  Inset inset_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> facets_of_;  ///< by triangle
  std::map<std::uint32_t, Vec3> moved_;
  std::vector<std::vector<Patch>> patches_;
};

bool lexicographic(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

ClosedMesh shell_of(const std::vector<Patch>& patches) {
  ClosedMesh shell;
  std::vector<std::pair<Vec3, Vec3>> corners;  // outer, inner
  for (const Patch& patch : patches) {
    for (std::size_t k = 0; k < 3; ++k) corners.emplace_back(patch.outer[k], patch.inner[k]);
  }
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return lexicographic(corners[a].first, corners[b].first); });
  std::vector<std::uint32_t> number(corners.size());
  for (const auto corner : order) {
    if (shell.vertices.empty() || shell.vertices[shell.vertices.size() - 2] != corners[corner].first) {
      shell.vertices.push_back(corners[corner].first);
      shell.vertices.push_back(corners[corner].second);
    }
    number[corner] = std::uint32_t(shell.vertices.size() - 2);  // its inner one follows
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      border;  // surplus of an edge's uses from low to high
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::array<std::uint32_t, 3> f{number[i], number[i + 1], number[i + 2]};
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    shell.facets.push_back(f);
    shell.facets.push_back({f[2] + 1, f[1] + 1, f[0] + 1});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = f[k], b = f[(k + 1) % 3];
      border[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, surplus] : border) {
    const auto [u, v] = surplus > 0 ? edge : std::pair(edge.second, edge.first);
    for (int i = 0; i < std::abs(surplus); ++i) {
      shell.facets.push_back({v, u, u + 1});
      shell.facets.push_back({v, u + 1, v + 1});
    }
  }
  shell.sources.assign(shell.facets.size(), no_source);
  pair_edges(shell);
  return shell;
}

}  // namespace

std::vector<ClosedMesh> painted_shells(const MeshBody& body, const ClosedMesh& mesh, double depth) {
  const Painter painter(body, mesh, depth);
  std::vector<ClosedMesh> shells;
  for (std::size_t tint = 0; tint < body.paints.size(); ++tint)
    shells.push_back(shell_of(painter.patches(tint)));
  return shells;
}

}  // namespace unicursal::core
