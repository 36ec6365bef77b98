#include "core/model/mesh_shells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/model/edge_pairing.hpp"
#include "core/model/ray_index.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

/// The other facet of each edge that joins just two.
std::vector<MeshEdge> neighbours(const ClosedMesh& mesh) {
  std::vector<MeshEdge> other(3 * mesh.facets.size(), no_half_edge);
  const std::vector<EdgeUse> uses = uses_by_edge(mesh);
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high) ++end;
    if (end - i == 2) {
      other[uses[i].half_edge] = uses[i + 1].half_edge;
      other[uses[i + 1].half_edge] = uses[i].half_edge;
    }
    i = end;
  }
  return other;
}

/// Floods over the edges. `turned`: whether a facet must be turned to agree with the rest of its piece.
class Flood {
 public:
  explicit Flood(const ClosedMesh& mesh)
      : turned(mesh.facets.size(), false),
        mesh_(mesh),
        other_(neighbours(mesh)),
        reached_(mesh.facets.size(), false) {
    for (std::uint32_t f = 0; f < mesh_.facets.size(); ++f) {
      if (!reached_[f]) flood_from(f);
    }
  }

  std::vector<bool> turned;
  bool two_sided = true;

 private:
  void flood_from(std::uint32_t first) {
    std::vector<std::uint32_t> piece{first};
    reached_[first] = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (MeshEdge h = 3 * piece[i], end = h + 3; h < end; ++h) visit(h, piece);
    }
    prefer_majority(piece);
  }

  void visit(MeshEdge h, std::vector<std::uint32_t>& piece) {
    const MeshEdge twin = other_[h];
    if (twin == no_half_edge) return;
    const bool should_turn = turned[h / 3] != (mesh_.from(h) == mesh_.from(twin));
    if (!reached_[twin / 3]) {
      reached_[twin / 3] = true;
      turned[twin / 3] = should_turn;
      piece.push_back(twin / 3);
    } else if (turned[twin / 3] != should_turn) {
      two_sided = false;
    }
  }

  void prefer_majority(const std::vector<std::uint32_t>& piece) {
    const auto count = std::count_if(piece.begin(), piece.end(), [&](auto f) { return turned[f]; });
    if (2 * std::size_t(count) <= piece.size()) return;
    for (const auto f : piece) turned[f] = !turned[f];
  }

  const ClosedMesh& mesh_;
  std::vector<MeshEdge> other_;
  std::vector<bool> reached_;
};

void measure(const ClosedMesh& mesh, Shell& shell) {
  const Vec3 origin = mesh.vertices[mesh.facets[shell.facets.front()][0]];
  for (const auto f : shell.facets) {
    const auto& [a, b, c] = mesh.facets[f];
    const Vec3 normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    shell.area += normal.norm() / 2;
    shell.volume += (mesh.vertices[a] - origin).dot(normal) / 6;
  }
}

/// Where the edge crosses height z; gives the same point for both facets of the edge.
Vec3 at_height(const Vec3& a, const Vec3& b, double z) {
  const Vec3 &low = a.z() <= z ? a : b, &high = a.z() <= z ? b : a;
  return low + (z - low.z()) / (high.z() - low.z()) * (high - low);
}

/// Whether the ray from p along +x crosses the facet. A vertex exactly at the height of the ray counts as
/// below it, in y as in z, so that rays through an edge or a vertex are counted correctly.
bool ray_passes(const ClosedMesh& mesh, std::uint32_t f, const Vec3& p) {
  Vec3 crossing[2];
  int count = 0;
  for (MeshEdge h = 3 * f; h < 3 * f + 3; ++h) {
    const Vec3 &a = mesh.vertices[mesh.from(h)], &b = mesh.vertices[mesh.to(h)];
    if ((a.z() > p.z()) != (b.z() > p.z())) crossing[count++] = at_height(a, b, p.z());
  }
  if (count != 2 || (crossing[0].y() > p.y()) == (crossing[1].y() > p.y())) return false;
  const double t = (p.y() - crossing[0].y()) / (crossing[1].y() - crossing[0].y());
  return crossing[0].x() + t * (crossing[1].x() - crossing[0].x()) > p.x();
}

/// Answers which shells contain which.
class Nesting {
 public:
  Nesting(const ClosedMesh& mesh, const std::vector<Shell>& shells)
      : mesh_(mesh), shells_(shells), owner_(mesh.facets.size()), index_(mesh) {
    for (std::uint32_t s = 0; s < shells.size(); ++s) {
      for (const auto f : shells[s].facets) owner_[f] = s;
    }
  }

  /// The shells around this one, ascending. Checks a few vertices all over it, since solids that merely
  /// overlap are not nested.
  std::vector<std::uint32_t> around(std::uint32_t shell) const {
    constexpr std::size_t probes = 8;
    const auto& facets = shells_[shell].facets;
    const std::size_t step = std::max<std::size_t>(1, facets.size() / probes);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < facets.size(); i += step) {
      const auto found = containing(mesh_.vertices[mesh_.facets[facets[i]][0]], shell);
      if (i == 0) {
        result = found;
      } else {
        std::erase_if(result, [&](auto s) { return !std::binary_search(found.begin(), found.end(), s); });
      }
      if (result.empty()) break;
    }
    return result;
  }

 private:
  std::vector<std::uint32_t> containing(const Vec3& p, std::uint32_t but) const {
    std::vector<std::uint32_t> crossed;
    for (const auto f : index_.near(p.y(), p.z())) {
      if (owner_[f] != but && ray_passes(mesh_, f, p)) crossed.push_back(owner_[f]);
    }
    std::sort(crossed.begin(), crossed.end());
    std::vector<std::uint32_t> result;
    for (auto s = crossed.begin(); s != crossed.end();) {
      const auto end = std::upper_bound(s, crossed.end(), *s);
      if ((end - s) % 2 == 1) result.push_back(*s);
      s = end;
    }
    return result;
  }

  const ClosedMesh& mesh_;
  const std::vector<Shell>& shells_;
  std::vector<std::uint32_t> owner_;
  RayIndex index_;
};

}  // namespace

Agreement agree(ClosedMesh& mesh) {
  const Flood flood(mesh);
  Agreement result{0, flood.two_sided};
  mesh.twins.clear();
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (!flood.turned[f]) continue;
    std::swap(mesh.facets[f][1], mesh.facets[f][2]);
    ++result.turned;
  }
  return result;
}

std::vector<Shell> shells_of(const ClosedMesh& mesh) {
  std::vector<Shell> shells;
  std::vector<bool> reached(mesh.facets.size(), false);
  for (std::uint32_t first = 0; first < mesh.facets.size(); ++first) {
    if (reached[first]) continue;
    Shell shell;
    shell.facets.push_back(first);
    reached[first] = true;
    for (std::size_t i = 0; i < shell.facets.size(); ++i) {
      for (MeshEdge h = 3 * shell.facets[i], end = h + 3; h < end; ++h) {
        const std::uint32_t next = mesh.twins[h] / 3;
        if (reached[next]) continue;
        reached[next] = true;
        shell.facets.push_back(next);
      }
    }
    measure(mesh, shell);
    shells.push_back(std::move(shell));
  }
  return shells;
}

std::size_t turn_shells(ClosedMesh& mesh, std::vector<Shell>& shells) {
  const auto inward = [&](std::uint32_t s) { return shells[s].volume < 0 && !shells[s].thin(); };
  std::vector<std::uint32_t> suspects;
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (inward(s)) suspects.push_back(s);
  }
  if (suspects.empty()) return 0;
  const Nesting nesting(mesh, shells);
  std::vector<bool> inside_out(shells.size(), false);
  bool any = false;
  for (const auto s : suspects) {
    stop_point();
    if (shells.size() == 1 || nesting.around(s).empty()) any = inside_out[s] = true;
  }
  if (!any) return 0;
  std::vector<bool> turned = inside_out;
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (inside_out[s]) continue;
    stop_point();
    const auto outer = nesting.around(s);
    turned[s] = std::any_of(outer.begin(), outer.end(), [&](auto o) { return inside_out[o]; });
  }
  std::size_t count = 0;
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (!turned[s]) continue;
    ++count;
    shells[s].volume = -shells[s].volume;
    for (const auto f : shells[s].facets) std::swap(mesh.facets[f][1], mesh.facets[f][2]);
  }
  pair_edges(mesh);
  return count;
}

std::vector<std::vector<std::uint32_t>> facets_of_solids(const ClosedMesh& mesh) {
  const std::vector<Shell> shells = shells_of(mesh);
  const auto outward = [&](std::uint32_t s) { return shells[s].volume > 0 && !shells[s].thin(); };
  const Nesting nesting(mesh, shells);
  std::vector<std::vector<std::uint32_t>> solids;
  std::vector<std::size_t> solid_of(shells.size(), 0);
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (!outward(s)) continue;
    solid_of[s] = solids.size();
    solids.push_back(shells[s].facets);
  }
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (outward(s) || shells[s].thin()) continue;
    const auto around = nesting.around(s);
    const auto owner = std::find_if(around.begin(), around.end(), outward);
    auto& facets = solids[owner == around.end() ? 0 : solid_of[*owner]];
    facets.insert(facets.end(), shells[s].facets.begin(), shells[s].facets.end());
  }
  return solids;
}

}  // namespace unicursal::core
