#include "core/model/closed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "core/error.hpp"
#include "core/model/edge_pairing.hpp"
#include "core/model/mesh_shells.hpp"

namespace unicursal::core {
namespace {

using Index = std::uint32_t;
using Facet = std::array<Index, 3>;

bool lexicographic(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Vertices with equal coordinates become one.
ClosedMesh indexed(const std::vector<Triangle>& triangles) {
  ClosedMesh mesh;
  for (const Triangle& t : triangles) mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
  std::vector<Index> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), Index{0});
  const std::vector<Vec3> corners = std::move(mesh.vertices);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return lexicographic(corners[a], corners[b]); });
  mesh.vertices.clear();
  mesh.facets.resize(triangles.size());
  for (const Index corner : order) {
    if (mesh.vertices.empty() || mesh.vertices.back() != corners[corner])
      mesh.vertices.push_back(corners[corner]);
    mesh.facets[corner / 3][corner % 3] = Index(mesh.vertices.size() - 1);
  }
  return mesh;
}

/// Finds an earlier vertex within `vertex_weld` through a grid of cells of that size.
class WeldGrid {
 public:
  explicit WeldGrid(const std::vector<Vec3>& vertices) : vertices_(vertices) {}

  /// Returns `v` itself if no earlier vertex is near; later calls can then find `v`.
  Index find_or_add(Index v) {
    const auto [x, y, z] = cell(vertices_[v]);
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(key(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1));
      if (found == cells_.end()) continue;
      for (const Index other : found->second) {
        if ((vertices_[other] - vertices_[v]).norm() <= vertex_weld) return other;
      }
    }
    cells_[key(x, y, z)].push_back(v);
    return v;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  static Cell cell(const Vec3& p) {
    return {std::llround(p.x() / vertex_weld), std::llround(p.y() / vertex_weld),
            std::llround(p.z() / vertex_weld)};
  }
  /// Different cells may share a key; the distance decides.
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::uint64_t(x) * 0x9e3779b97f4a7c15u ^ std::uint64_t(y) * 0xc2b2ae3d27d4eb4fu ^
           std::uint64_t(z) * 0x165667b19e3779f9u;
  }

  const std::vector<Vec3>& vertices_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

void weld_near(ClosedMesh& mesh) {
  WeldGrid grid(mesh.vertices);
  std::vector<Index> target(mesh.vertices.size());
  for (Index v = 0; v < target.size(); ++v) target[v] = grid.find_or_add(v);
  for (Facet& facet : mesh.facets) {
    for (Index& v : facet) v = target[v];
  }
}

/// Drops facets with two equal corners. Their other two sides are one edge, so no hole opens.
std::size_t drop_collapsed(ClosedMesh& mesh) {
  return std::erase_if(mesh.facets,
                       [](const Facet& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; });
}

/// The three corners rotated so that the smallest comes first, which keeps the orientation.
Facet rotated(Facet f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

/// Treats facets with the same three corners: two of opposite orientation are a wall between solids in
/// contact and are both dropped; copies of the same orientation count once.
std::size_t drop_coincident(ClosedMesh& mesh) {
  std::map<Facet, std::vector<std::size_t>> by_corners;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    Facet key = mesh.facets[i];
    std::sort(key.begin(), key.end());
    by_corners[key].push_back(i);
  }
  std::vector<bool> drop(mesh.facets.size(), false);
  for (const auto& [key, same] : by_corners) {
    if (same.size() < 2) continue;
    const auto sense = [&](std::size_t i) {
      return rotated(mesh.facets[i]) == rotated(mesh.facets[same.front()]);
    };
    const bool wall = !std::all_of(same.begin(), same.end(), sense);
    for (std::size_t k = wall ? 0 : 1; k < same.size(); ++k) drop[same[k]] = true;
  }
  std::vector<Facet> kept;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    if (!drop[i]) kept.push_back(mesh.facets[i]);
  }
  const std::size_t dropped = mesh.facets.size() - kept.size();
  mesh.facets = std::move(kept);
  return dropped;
}

struct Cleaned {
  std::size_t collapsed = 0, coincident = 0;
};

Cleaned clean(ClosedMesh& mesh) {
  Cleaned result;
  result.collapsed = drop_collapsed(mesh);
  result.coincident = drop_coincident(mesh);
  return result;
}

std::string edge_text(const std::pair<Vec3, Vec3>& edge) {
  const auto& [a, b] = edge;
  return fmt::format("the edge from ({:.4f}, {:.4f}, {:.4f}) to ({:.4f}, {:.4f}, {:.4f}) mm", a.x(), a.y(),
                     a.z(), b.x(), b.y(), b.z());
}

void refuse_unpaired(const EdgePairing& edges, const std::string& file) {
  if (edges.open > 0) {
    throw ModelError(file, edge_text(*edges.example),
                     fmt::format("the mesh is open: {} edges have only one facet", edges.open),
                     "close its holes in a modelling or mesh repair program");
  }
  if (edges.tangled > 0) {
    throw ModelError(
        file, edge_text(*edges.example),
        fmt::format("at {} edges more than two facets meet without bounding a solid", edges.tangled),
        "unite the bodies in a modelling program, or repair the mesh");
  }
}

void warn_of_repairs(const Cleaned& cleaned, const Turned& turned, const std::string& file,
                     Warnings& warnings) {
  const auto warn = [&](std::size_t count, const char* what) {
    if (count > 0) warnings.add(fmt::format("{}: {} {}", file, count, what));
  };
  warn(cleaned.collapsed, "facets without area were dropped");
  warn(cleaned.coincident, "facets lying on one another were dropped");
  warn(turned.facets, "facets faced the wrong way and were turned");
  warn(turned.shells, "shells were inside out and were turned");
}

}  // namespace

ClosedMesh closed_mesh(const std::vector<Triangle>& triangles, const std::string& file, Warnings& warnings) {
  ClosedMesh mesh = indexed(triangles);
  Cleaned cleaned = clean(mesh);
  EdgePairing edges = pair_edges(mesh);
  if (edges.open > 0 || edges.tangled > 0) {
    weld_near(mesh);
    const Cleaned again = clean(mesh);
    cleaned.collapsed += again.collapsed;
    cleaned.coincident += again.coincident;
    edges = pair_edges(mesh);
  }
  refuse_unpaired(edges, file);
  if (mesh.facets.empty())
    throw ModelError(file, "", "the mesh encloses no volume", "export the model again");
  const Turned turned = orient(mesh);
  if (!turned.two_sided) {
    throw ModelError(file, "", "the surface has only one side, so it bounds no solid", "model it again");
  }
  warn_of_repairs(cleaned, turned, file, warnings);
  return mesh;
}

}  // namespace unicursal::core
