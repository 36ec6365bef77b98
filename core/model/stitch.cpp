#include "core/model/stitch.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>

#include "core/model/edge_pairing.hpp"

namespace unicursal::core {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Entry = std::pair<Point, std::uint32_t>;
using Tree = bg::index::rtree<Entry, bg::index::rstar<16>>;

constexpr int most_rounds = 8;  ///< of splitting; each round splits a facet along one side
constexpr std::size_t most_candidates =
    50000000;  ///< vertices compared with edges; a limit for hostile files

Point point(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Tree tree_of(const ClosedMesh& mesh, const std::vector<MeshEdge>& borders) {
  std::vector<std::uint32_t> ends;
  for (const MeshEdge h : borders) ends.insert(ends.end(), {mesh.from(h), mesh.to(h)});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Entry> entries;
  for (const auto v : ends) entries.emplace_back(point(mesh.vertices[v]), v);
  return Tree(entries);
}

/// The vertices within the edge, from its beginning to its end.
std::vector<std::uint32_t> on_edge(const ClosedMesh& mesh, MeshEdge h, const Tree& tree, double reach,
                                   std::size_t& budget) {
  const Vec3 &a = mesh.vertices[mesh.from(h)], &b = mesh.vertices[mesh.to(h)], way = b - a;
  const double length = way.norm();
  std::vector<std::pair<double, std::uint32_t>> found;
  if (length <= 2 * reach) return {};
  const Vec3 low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
  const auto inside = bg::index::intersects(bg::model::box<Point>(point(low), point(high)));
  for (auto entry = tree.qbegin(inside); entry != tree.qend() && budget > 0; ++entry, --budget) {
    const Vec3 to = mesh.vertices[entry->second] - a;
    const double along = to.dot(way) / length;
    if (along <= reach || along >= length - reach) continue;
    if ((to - along / length * way).norm() <= reach) found.emplace_back(along, entry->second);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> result;
  for (const auto& [along, v] : found) result.push_back(v);
  return result;
}

void split(ClosedMesh& mesh, MeshEdge h, const std::vector<std::uint32_t>& at) {
  const std::uint32_t facet = h / 3, end = mesh.to(h), third = mesh.facets[facet][(h % 3 + 2) % 3];
  const std::uint32_t source = mesh.sources[facet];
  mesh.facets[facet] = {mesh.from(h), at.front(), third};
  for (std::size_t i = 0; i < at.size(); ++i) {
    mesh.facets.push_back({at[i], i + 1 < at.size() ? at[i + 1] : end, third});
    mesh.sources.push_back(source);
  }
}

}  // namespace

std::size_t stitch(ClosedMesh& mesh, std::vector<MeshEdge> borders, double reach) {
  std::size_t stitches = 0, budget = most_candidates;
  for (int round = 0; round < most_rounds && !borders.empty(); ++round) {
    const Tree tree = tree_of(mesh, borders);
    std::size_t found = 0;
    std::uint32_t last = no_source;  // borders are sorted, so those of one facet follow each other
    for (const MeshEdge h : borders) {
      if (h / 3 == last) continue;
      const auto at = on_edge(mesh, h, tree, reach, budget);
      if (at.empty()) continue;
      last = h / 3;
      found += at.size();
      split(mesh, h, at);
    }
    if (found == 0) break;
    stitches += found;
    borders = pair_edges(mesh);
  }
  return stitches;
}

}  // namespace unicursal::core
