#include "core/model/slicer.hpp"

#include <algorithm>
#include <utility>

namespace unicursal::core {
namespace {

/// The half-edge through which the contour leaves the facet: it rises through the plane.
/// Precondition: the facet crosses the plane.
MeshEdge rising(const ClosedMesh& mesh, std::uint32_t facet, double z) {
  MeshEdge h = 3 * facet;
  while (!(mesh.vertices[mesh.from(h)].z() <= z && mesh.vertices[mesh.to(h)].z() > z)) ++h;
  return h;
}

Vec2 crossing(const ClosedMesh& mesh, MeshEdge h, double z) {
  const Vec3 &low = mesh.vertices[mesh.from(h)], &high = mesh.vertices[mesh.to(h)];
  return (low + (z - low.z()) / (high.z() - low.z()) * (high - low)).head<2>();
}

}  // namespace

Slicer::Slicer(ClosedMesh mesh) : mesh_(std::move(mesh)), index_(height_spans(mesh_)) {}

std::vector<Ring> Slicer::contours(double z) const {
  const std::vector<std::uint32_t> passed = index_.at(z);
  std::vector<bool> done(passed.size(), false);
  const auto rank = [&](std::uint32_t facet) {
    return std::size_t(std::lower_bound(passed.begin(), passed.end(), facet) - passed.begin());
  };
  std::vector<Ring> result;
  for (std::size_t first = 0; first < passed.size(); ++first) {
    if (done[first]) continue;
    Ring ring;
    for (std::size_t i = first; !done[i];) {
      done[i] = true;
      const MeshEdge out = rising(mesh_, passed[i], z);
      ring.push_back(crossing(mesh_, out, z));
      i = rank(mesh_.twins[out] / 3);
    }
    result.push_back(std::move(ring));
  }
  return result;
}

}  // namespace unicursal::core
