#include "core/model/edge_pairing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

namespace unicursal::core {
namespace {

struct Use {
  std::uint32_t low, high;  ///< the edge's vertices
  HalfEdge half_edge;

  auto edge() const { return std::tie(low, high); }
};

std::vector<Use> uses_by_edge(const ClosedMesh& mesh) {
  std::vector<Use> uses;
  uses.reserve(3 * mesh.facets.size());
  for (HalfEdge h = 0; h < 3 * mesh.facets.size(); ++h) {
    const auto [low, high] = std::minmax({mesh.from(h), mesh.to(h)});
    uses.push_back({low, high, h});
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
  });
  return uses;
}

/// Measures the angles of facets around an edge, counter-clockwise as seen looking from `high` towards `low`.
class Around {
 public:
  Around(const ClosedMesh& mesh, const Use& use) : mesh_(mesh), origin_(mesh.vertices[use.low]) {
    axis_ = (mesh.vertices[use.high] - origin_).normalized();
    right_ = axis_.unitOrthogonal();
    up_ = axis_.cross(right_);
  }

  double angle(HalfEdge h) const {
    const Vec3 to_third = mesh_.vertices[mesh_.facets[h / 3][(h % 3 + 2) % 3]] - origin_;
    return std::atan2(to_third.dot(up_), to_third.dot(right_));
  }

 private:
  const ClosedMesh& mesh_;
  Vec3 origin_, axis_, right_, up_;
};

/// A facet that runs against the edge (high to low) has material on the side of growing angles. It belongs to
/// the first facet in that direction that runs along the edge. Returns false if that choice is not
/// one-to-one.
bool pair_wedges(ClosedMesh& mesh, std::span<const Use> uses) {
  constexpr double touching = 1e-6;  // radians: a wedge this thin is the contact of two solids, not material
  const Around around(mesh, uses.front());
  std::vector<HalfEdge> taken;
  for (const Use& start : uses) {
    if (mesh.from(start.half_edge) == start.low) continue;
    double least = 10;
    HalfEdge best = start.half_edge;
    for (const Use& end : uses) {
      if (mesh.from(end.half_edge) != end.low) continue;
      double wedge = around.angle(end.half_edge) - around.angle(start.half_edge);
      while (wedge < touching) wedge += 2 * std::numbers::pi;
      if (wedge < least) least = wedge, best = end.half_edge;
    }
    if (best == start.half_edge || std::find(taken.begin(), taken.end(), best) != taken.end()) return false;
    taken.push_back(best);
    mesh.twins[start.half_edge] = best;
    mesh.twins[best] = start.half_edge;
  }
  return 2 * taken.size() == uses.size();
}

bool pair_uses(ClosedMesh& mesh, std::span<const Use> uses) {
  constexpr std::size_t most = 64;  // facets at one edge; more mean damage, not touching solids
  if (uses.size() % 2 != 0 || uses.size() > most) return false;
  if (uses.size() > 2) return pair_wedges(mesh, uses);
  mesh.twins[uses[0].half_edge] = uses[1].half_edge;
  mesh.twins[uses[1].half_edge] = uses[0].half_edge;
  return true;
}

}  // namespace

EdgePairing pair_edges(ClosedMesh& mesh) {
  EdgePairing result;
  mesh.twins.assign(3 * mesh.facets.size(), 0);
  const std::vector<Use> uses = uses_by_edge(mesh);
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last =
        std::find_if(first, uses.end(), [&](const Use& use) { return use.edge() != first->edge(); });
    const bool open = last - first == 1;
    if (open || !pair_uses(mesh, {first, last})) {
      if (!result.example || (open && result.open == 0)) {
        result.example = std::pair(mesh.vertices[first->low], mesh.vertices[first->high]);
      }
      ++(open ? result.open : result.tangled);
    }
    first = last;
  }
  return result;
}

}  // namespace unicursal::core
