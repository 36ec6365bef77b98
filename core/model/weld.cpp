#include "core/model/weld.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace unicursal::core {
namespace {

using VertexNumber = std::uint32_t;
using Facet = std::array<VertexNumber, 3>;

bool lexicographic(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Finds an earlier vertex through a grid of cells that are much larger than the distance, so that few
/// searches have to look into a neighbouring cell.
class WeldGrid {
 public:
  WeldGrid(const std::vector<Vec3>& vertices, double distance)
      : vertices_(vertices), distance_(distance), next_(vertices.size(), none) {
    first_.reserve(vertices.size() / 2);
  }

  /// Returns `v` itself if no earlier vertex is near; later calls can then find `v`.
  VertexNumber find_or_add(VertexNumber v) {
    const Cell low = cell(vertices_[v].array() - distance_), high = cell(vertices_[v].array() + distance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          if (const VertexNumber found = find_in({x, y, z}, v); found != none) return found;
        }
      }
    }
    const auto added = first_.try_emplace(key(cell(vertices_[v])), v);
    if (!added.second) next_[v] = std::exchange(added.first->second, v);
    return v;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr VertexNumber none = std::numeric_limits<VertexNumber>::max();
  static constexpr double cell_size = 16;  // in weld distances

  Cell cell(const Vec3& p) const {
    const auto number = [&](double x) {
      return static_cast<std::int64_t>(std::floor(x / (cell_size * distance_)));
    };
    return {number(p.x()), number(p.y()), number(p.z())};
  }
  /// Different cells may share a key; the distance decides.
  static std::uint64_t key(const Cell& c) {
    return std::uint64_t(c[0]) * 0x9e3779b97f4a7c15u ^ std::uint64_t(c[1]) * 0xc2b2ae3d27d4eb4fu ^
           std::uint64_t(c[2]) * 0x165667b19e3779f9u;
  }
  VertexNumber find_in(const Cell& cell, VertexNumber v) const {
    const auto found = first_.find(key(cell));
    if (found == first_.end()) return none;
    for (VertexNumber other = found->second; other != none; other = next_[other]) {
      if ((vertices_[other] - vertices_[v]).norm() <= distance_) return other;
    }
    return none;
  }

  const std::vector<Vec3>& vertices_;
  double distance_;
  std::unordered_map<std::uint64_t, VertexNumber> first_;  ///< per cell: the vertex that came last
  std::vector<VertexNumber> next_;                         ///< the one that came before it in the same cell
};

template <class Predicate>
std::size_t drop(ClosedMesh& mesh, Predicate unwanted) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (unwanted(f)) continue;
    mesh.facets[kept] = mesh.facets[f];
    mesh.sources[kept++] = mesh.sources[f];
  }
  const std::size_t dropped = mesh.facets.size() - kept;
  mesh.facets.resize(kept);
  mesh.sources.resize(kept);
  return dropped;
}

/// The three corners rotated so that the smallest comes first, which keeps the orientation.
Facet rotated(Facet f) {
  std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
  return f;
}

}  // namespace

ClosedMesh indexed(const std::vector<Triangle>& triangles) {
  ClosedMesh mesh;
  std::vector<Vec3> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<VertexNumber> order(corners.size());
  std::iota(order.begin(), order.end(), VertexNumber{0});
  std::sort(order.begin(), order.end(),
            [&](VertexNumber a, VertexNumber b) { return lexicographic(corners[a], corners[b]); });
  mesh.facets.resize(triangles.size());
  for (const VertexNumber corner : order) {
    if (mesh.vertices.empty() || mesh.vertices.back() != corners[corner])
      mesh.vertices.push_back(corners[corner]);
    mesh.facets[corner / 3][corner % 3] = VertexNumber(mesh.vertices.size() - 1);
  }
  mesh.sources.resize(triangles.size());
  std::iota(mesh.sources.begin(), mesh.sources.end(), VertexNumber{0});
  return mesh;
}

double weld_distance(const ClosedMesh& mesh) {
  constexpr double least = 1e-4, steps = 8;  // steps of a float
  double farthest = 0;
  for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, v.cwiseAbs().maxCoeff());
  return std::max(least, steps * farthest * double(std::numeric_limits<float>::epsilon()));
}

std::size_t weld(ClosedMesh& mesh, double distance) {
  WeldGrid grid(mesh.vertices, distance);
  std::vector<VertexNumber> target(mesh.vertices.size());
  std::size_t moved = 0;
  for (VertexNumber v = 0; v < target.size(); ++v) {
    target[v] = grid.find_or_add(v);
    if (target[v] != v) ++moved;
  }
  for (Facet& facet : mesh.facets) {
    for (VertexNumber& v : facet) v = target[v];
  }
  return moved;
}

std::size_t drop_collapsed(ClosedMesh& mesh) {
  return drop(mesh, [&](std::size_t i) {
    const Facet& f = mesh.facets[i];
    return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
  });
}

std::size_t drop_copies(ClosedMesh& mesh, const std::vector<MeshEdge>& borders) {
  std::map<std::pair<VertexNumber, VertexNumber>, std::size_t> surplus;  // by the half-edge's ends
  for (const MeshEdge h : borders) ++surplus[{mesh.from(h), mesh.to(h)}];
  std::map<Facet, std::size_t> seen;
  std::vector<bool> unwanted(mesh.facets.size(), false);
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Facet& f = mesh.facets[i];
    std::array<std::size_t*, 3> sides{};
    bool all = true;
    for (std::size_t k = 0; k < 3 && all; ++k) {
      const auto found = surplus.find({f[k], f[(k + 1) % 3]});
      all = found != surplus.end() && found->second > 0;
      if (all) sides[k] = &found->second;
    }
    if (!all || seen[rotated(f)]++ == 0) continue;
    unwanted[i] = true;
    for (std::size_t* side : sides) --*side;
  }
  return drop(mesh, [&](std::size_t i) { return unwanted[i]; });
}

}  // namespace unicursal::core
