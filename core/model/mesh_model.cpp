#include "core/model/mesh_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/model/edge_pairing.hpp"
#include "core/model/weld.hpp"
#include "core/numeric/disjoint_sets.hpp"

namespace unicursal::core {
namespace {

double area_of(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
}

/// Per triangle the number of the piece that it belongs to. Pieces are connected through edges; solids in
/// contact are pieces of their own.
std::vector<std::size_t> pieces_of(const std::vector<Triangle>& triangles) {
  ClosedMesh mesh = indexed(triangles);
  pair_edges(mesh);
  DisjointSets sets(triangles.size());
  for (MeshEdge h = 0; h < mesh.twins.size(); ++h) {
    if (mesh.twins[h] != no_half_edge) sets.join(h / 3, mesh.twins[h] / 3);
  }
  std::vector<std::size_t> result;
  for (std::size_t t = 0; t < triangles.size(); ++t) result.push_back(sets.find(t));
  return result;
}

/// The tint with most area among some triangles.
std::uint32_t main_tint(const MeshBody& body, const std::vector<std::uint32_t>& tints,
                        const std::vector<std::uint32_t>& members) {
  std::map<std::uint32_t, double> areas;
  for (const auto t : members) areas[tints[t]] += area_of(body.triangles[t]);
  return std::max_element(areas.begin(), areas.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

MeshModel divided_by_tint(MeshBody body, const std::vector<std::uint32_t>& tints,
                          const std::vector<Tint>& palette) {
  static const Tint none;
  const auto tint = [&](std::uint32_t index) -> const Tint& {
    return index < palette.size() ? palette[index] : none;
  };
  if (body.triangles.empty()) return {};
  if (std::all_of(tints.begin(), tints.end(), [&](auto t) { return t == tints.front(); })) {
    body.tint = tint(tints.front());
    return {std::move(body)};
  }
  // Pieces with the same main tint are one body, in the order of their first triangles.
  std::map<std::size_t, std::vector<std::uint32_t>> pieces;
  const auto piece_of = pieces_of(body.triangles);
  for (std::uint32_t t = 0; t < tints.size(); ++t) pieces[piece_of[t]].push_back(t);
  std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> groups;
  std::map<std::uint32_t, std::size_t> group_of;  // by main tint
  std::vector<std::vector<std::uint32_t>> in_order;
  for (auto& [piece, members] : pieces) in_order.push_back(std::move(members));
  std::sort(in_order.begin(), in_order.end());
  for (const auto& members : in_order) {
    const std::uint32_t main = main_tint(body, tints, members);
    const auto [known, added] = group_of.try_emplace(main, groups.size());
    if (added) groups.push_back({main, {}});
    auto& group = groups[known->second].second;
    group.insert(group.end(), members.begin(), members.end());
  }
  MeshModel result;
  for (auto& [main, members] : groups) {
    MeshBody part{body.names, tint(main), body.role, body.object, {}, {}, {}};
    std::map<std::uint32_t, std::uint32_t> paint_of;  // by tint
    for (const auto t : members) {
      if (tints[t] != main && tint(tints[t]) != none) {
        const auto [known, added] = paint_of.try_emplace(tints[t], std::uint32_t(part.paints.size()));
        if (added) part.paints.push_back(tint(tints[t]));
        part.painted.push_back({std::uint32_t(part.triangles.size()), known->second});
      }
      part.triangles.push_back(body.triangles[t]);
    }
    result.push_back(std::move(part));
  }
  return result;
}

}  // namespace unicursal::core
