#include "core/model/mesh_shells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace unicursal::core {
namespace {

struct Shell {
  std::vector<std::uint32_t> facets;
  Eigen::AlignedBox3d box;
  double volume = 0;  ///< mm³, negative if the facets face inwards
};

/// Reverses the facet's orientation; half-edges 0 and 2 change places.
void turn(ClosedMesh& mesh, const std::vector<bool>& turned) {
  const auto renamed = [&](HalfEdge h) { return turned[h / 3] ? 3 * (h / 3) + (2 - h % 3) : h; };
  std::vector<HalfEdge> twins(mesh.twins.size());
  for (HalfEdge h = 0; h < twins.size(); ++h) twins[renamed(h)] = renamed(mesh.twins[h]);
  mesh.twins = std::move(twins);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (turned[f]) std::swap(mesh.facets[f][1], mesh.facets[f][2]);
  }
}

/// Floods over the edges. `turned`: whether a facet must be turned to agree with the first one of its shell.
class Flood {
 public:
  explicit Flood(const ClosedMesh& mesh)
      : turned(mesh.facets.size(), false), mesh_(mesh), reached_(mesh.facets.size(), false) {}

  void run() {
    for (std::uint32_t f = 0; f < mesh_.facets.size(); ++f) {
      if (!reached_[f]) shells.push_back(shell_from(f));
    }
  }

  std::vector<bool> turned;
  std::vector<Shell> shells;
  bool two_sided = true;

 private:
  Shell shell_from(std::uint32_t first) {
    Shell shell;
    shell.facets.push_back(first);
    reached_[first] = true;
    for (std::size_t i = 0; i < shell.facets.size(); ++i) {
      for (HalfEdge h = 3 * shell.facets[i], end = h + 3; h < end; ++h) visit(h, shell);
    }
    prefer_majority(shell);
    return shell;
  }

  void visit(HalfEdge h, Shell& shell) {
    const HalfEdge twin = mesh_.twins[h];
    const bool same_sense = mesh_.from(h) == mesh_.from(twin);
    const bool should_turn = turned[h / 3] != same_sense;
    if (!reached_[twin / 3]) {
      reached_[twin / 3] = true;
      turned[twin / 3] = should_turn;
      shell.facets.push_back(twin / 3);
    } else if (turned[twin / 3] != should_turn) {
      two_sided = false;
    }
  }

  void prefer_majority(const Shell& shell) {
    const auto count =
        std::count_if(shell.facets.begin(), shell.facets.end(), [&](auto f) { return turned[f]; });
    if (2 * std::size_t(count) <= shell.facets.size()) return;
    for (const auto f : shell.facets) turned[f] = !turned[f];
  }

  const ClosedMesh& mesh_;
  std::vector<bool> reached_;
};

void measure(const ClosedMesh& mesh, Shell& shell) {
  const Vec3 origin = mesh.vertices[mesh.facets[shell.facets.front()][0]];
  for (const auto f : shell.facets) {
    const auto& [a, b, c] = mesh.facets[f];
    for (const auto v : {a, b, c}) shell.box.extend(mesh.vertices[v]);
    shell.volume +=
        (mesh.vertices[a] - origin).dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin)) / 6;
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
  for (HalfEdge h = 3 * f; h < 3 * f + 3; ++h) {
    const Vec3 &a = mesh.vertices[mesh.from(h)], &b = mesh.vertices[mesh.to(h)];
    if ((a.z() > p.z()) != (b.z() > p.z())) crossing[count++] = at_height(a, b, p.z());
  }
  if (count != 2 || (crossing[0].y() > p.y()) == (crossing[1].y() > p.y())) return false;
  const double t = (p.y() - crossing[0].y()) / (crossing[1].y() - crossing[0].y());
  return crossing[0].x() + t * (crossing[1].x() - crossing[0].x()) > p.x();
}

bool inside(const ClosedMesh& mesh, const Shell& shell, const Vec3& p) {
  const auto count =
      std::count_if(shell.facets.begin(), shell.facets.end(), [&](auto f) { return ray_passes(mesh, f, p); });
  return count % 2 == 1;
}

/// Checks a few vertices all over the inner shell, since solids that merely overlap are not nested.
bool nested(const ClosedMesh& mesh, const Shell& inner, const Shell& outer) {
  if (!outer.box.contains(inner.box)) return false;
  constexpr std::size_t probes = 16;
  const std::size_t step = std::max<std::size_t>(1, inner.facets.size() / probes);
  for (std::size_t i = 0; i < inner.facets.size(); i += step) {
    if (!inside(mesh, outer, mesh.vertices[mesh.facets[inner.facets[i]][0]])) return false;
  }
  return true;
}

std::size_t depth(const ClosedMesh& mesh, const Shell& shell, const std::vector<Shell>& shells) {
  return std::size_t(std::count_if(shells.begin(), shells.end(), [&](const Shell& other) {
    return &other != &shell && nested(mesh, shell, other);
  }));
}

}  // namespace

Turned orient(ClosedMesh& mesh) {
  Turned result;
  Flood flood(mesh);
  flood.run();
  result.two_sided = flood.two_sided;
  if (!result.two_sided) return result;
  result.facets = std::size_t(std::count(flood.turned.begin(), flood.turned.end(), true));
  turn(mesh, flood.turned);
  for (Shell& shell : flood.shells) measure(mesh, shell);
  std::vector<bool> turned(mesh.facets.size(), false);
  for (const Shell& shell : flood.shells) {
    const bool cavity = depth(mesh, shell, flood.shells) % 2 == 1;
    if ((shell.volume < 0) == cavity) continue;
    ++result.shells;
    for (const auto f : shell.facets) turned[f] = true;
  }
  turn(mesh, turned);
  return result;
}

}  // namespace unicursal::core
