#include "core/model/edge_pairing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

namespace unicursal::core {
namespace {

constexpr std::size_t most_wedges = 64;  ///< facets at one edge; more mean damage, not touching solids

/// Measures the angles of facets around an edge, counter-clockwise as seen looking from `high` towards `low`.
class Around {
 public:
  Around(const ClosedMesh& mesh, const EdgeUse& use) : mesh_(mesh), origin_(mesh.vertices[use.low]) {
    axis_ = (mesh.vertices[use.high] - origin_).normalized();
    right_ = axis_.unitOrthogonal();
    up_ = axis_.cross(right_);
  }

  double angle(MeshEdge h) const {
    const Vec3 to_third = mesh_.vertices[mesh_.facets[h / 3][(h % 3 + 2) % 3]] - origin_;
    return std::atan2(to_third.dot(up_), to_third.dot(right_));
  }

 private:
  const ClosedMesh& mesh_;
  Vec3 origin_, axis_, right_, up_;
};

void join(ClosedMesh& mesh, MeshEdge a, MeshEdge b) {
  mesh.twins[a] = b;
  mesh.twins[b] = a;
}

/// A facet that runs against the edge (high to low) has material on the side of growing angles. It belongs to
/// the first facet in that direction that runs along the edge and is still free.
void pair_wedges(ClosedMesh& mesh, std::span<const EdgeUse> uses) {
  constexpr double touching = 1e-6;  // radians: a wedge this thin is the contact of two solids, not material
  const Around around(mesh, uses.front());
  for (const EdgeUse& start : uses) {
    if (mesh.from(start.half_edge) == start.low) continue;
    double least = 10;
    MeshEdge best = no_half_edge;
    for (const EdgeUse& end : uses) {
      if (mesh.from(end.half_edge) != end.low || mesh.twins[end.half_edge] != no_half_edge) continue;
      double wedge = around.angle(end.half_edge) - around.angle(start.half_edge);
      while (wedge < touching) wedge += 2 * std::numbers::pi;
      if (wedge < least) least = wedge, best = end.half_edge;
    }
    if (best != no_half_edge) join(mesh, start.half_edge, best);
  }
}

/// Pairs those that are left.
void pair_in_order(ClosedMesh& mesh, std::span<const EdgeUse> uses) {
  const auto free = [&](const EdgeUse& use, bool along) {
    return mesh.twins[use.half_edge] == no_half_edge && (mesh.from(use.half_edge) == use.low) == along;
  };
  auto end = uses.begin();
  for (const EdgeUse& start : uses) {
    if (!free(start, false)) continue;
    end = std::find_if(end, uses.end(), [&](const EdgeUse& use) { return free(use, true); });
    if (end == uses.end()) return;
    join(mesh, start.half_edge, end->half_edge);
  }
}

void pair_uses(ClosedMesh& mesh, std::span<const EdgeUse> uses) {
  if (uses.size() > 2 && uses.size() <= most_wedges) pair_wedges(mesh, uses);
  pair_in_order(mesh, uses);
}

}  // namespace

std::vector<EdgeUse> uses_by_edge(const ClosedMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.facets.size());
  for (MeshEdge h = 0; h < 3 * mesh.facets.size(); ++h) {
    const auto [low, high] = std::minmax({mesh.from(h), mesh.to(h)});
    uses.push_back({low, high, h});
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
  });
  return uses;
}

std::vector<MeshEdge> pair_edges(ClosedMesh& mesh) {
  mesh.twins.assign(3 * mesh.facets.size(), no_half_edge);
  const std::vector<EdgeUse> uses = uses_by_edge(mesh);
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const EdgeUse& use) {
      return use.low != first->low || use.high != first->high;
    });
    pair_uses(mesh, {first, last});
    first = last;
  }
  std::vector<MeshEdge> alone;
  for (MeshEdge h = 0; h < mesh.twins.size(); ++h) {
    if (mesh.twins[h] == no_half_edge) alone.push_back(h);
  }
  return alone;
}

}  // namespace unicursal::core
