#include "core/model/mesh_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/model/closed_mesh.hpp"
#include "core/model/edge_pairing.hpp"
#include "core/model/mesh_shells.hpp"
#include "core/model/painted_shell.hpp"
#include "core/model/read_mesh_model.hpp"

namespace unicursal::core {
namespace {

/// Mirrored triangles change the order of two corners, so that they face outwards again.
void rescale(MeshBody& body, const Vec3& scale, const std::filesystem::path& file) {
  if (scale == Vec3::Ones()) return;
  constexpr double farthest = 1e5;  // mm, as the readers allow
  const bool mirrored = scale.prod() < 0;
  for (Triangle& triangle : body.triangles) {
    for (Vec3& corner : triangle) {
      corner = corner.cwiseProduct(scale);
      if (corner.cwiseAbs().maxCoeff() <= farthest) continue;
      throw ModelError(file.string(), "", "its unit and scale put a vertex more than 100 m away",
                       "write smaller ones");
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
  }
  if (!mirrored) return;
  for (PaintedPiece& piece : body.painted) {
    for (Vec3& corner : piece.corners) std::swap(corner[1], corner[2]);
    std::swap(piece.corners[1], piece.corners[2]);
  }
}

ClosedMesh only(const ClosedMesh& mesh, std::vector<std::uint32_t> facets) {
  std::sort(facets.begin(), facets.end());
  ClosedMesh result;
  std::unordered_map<std::uint32_t, std::uint32_t> renamed;
  for (const auto f : facets) {
    auto& facet = result.facets.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.facets[f][k];
      const auto [known, added] = renamed.try_emplace(v, std::uint32_t(result.vertices.size()));
      if (added) result.vertices.push_back(mesh.vertices[v]);
      facet[k] = known->second;
    }
    result.sources.push_back(mesh.sources[f]);
  }
  pair_edges(result);
  return result;
}

/// Divides a mesh into its solids; voids stay with the solid around them.
std::vector<ClosedMesh> solids_of(ClosedMesh mesh) {
  std::vector<std::vector<std::uint32_t>> solids = facets_of_solids(mesh);
  std::vector<ClosedMesh> result;
  if (solids.size() == 1 || solids.size() > most_shell_bodies) {
    result.push_back(std::move(mesh));
  } else {
    for (auto& facets : solids) result.push_back(only(mesh, std::move(facets)));
  }
  return result;
}

}  // namespace

void add_bodies(std::vector<MendedBody>& bodies, const std::filesystem::path& file,
                const BodyOptions& options, Warnings& warnings) {
  MeshModel model = read_mesh_model(file, warnings);
  const std::size_t objects = bodies.empty() ? 0 : bodies.back().object + 1;
  std::size_t number = 0;
  std::optional<NothingEnclosed> empty;
  bool printable = false;
  for (MeshBody& body : model) {
    rescale(body, options.scale, file);
    MendedBody mended;
    mended.name = {file, "", body.names, body.tint, false};
    mended.role = body.role;
    mended.object = objects + body.object;
    mended.paints = body.paints;
    const auto numbered = [&] { return fmt::format("body {}", ++number); };
    std::string label = file.string();
    if (model.size() > 1) {
      mended.name.number = numbered();
      label += ": " + mended.name.number;
      if (!body.names.empty()) label += " (" + in_quotes(body.names.front()) + ")";
    }
    ClosedMesh mesh;
    Warnings notes;
    try {
      mesh = closed_mesh(body.triangles, label, notes);
    } catch (const NothingEnclosed& refusal) {
      if (model.size() == 1) throw;
      if (!empty) empty = refusal;
      warnings.add(label + ": it encloses no volume and was left out");
      body = {};
      continue;
    }
    for (std::string& note : notes.sentences()) warnings.add(std::move(note));
    printable = printable || body.role == BodyRole::solid;
    if (!body.painted.empty()) mended.shells = painted_shells(body, mesh, options.paint_depth);
    if (!options.shells_are_bodies || model.size() > 1 || !body.names.empty() || !body.painted.empty()) {
      if (mended.name.number.empty()) mended.name.number = numbered();
      mended.mesh = std::move(mesh);
      bodies.push_back(std::move(mended));
    } else {
      for (ClosedMesh& solid : solids_of(std::move(mesh))) {
        MendedBody one = mended;
        one.name.number = numbered();
        one.mesh = std::move(solid);
        bodies.push_back(std::move(one));
      }
    }
    body = {};
  }
  if (empty && !printable) throw NothingEnclosed(*empty);
}

double volume(const ClosedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.facets)
    sum += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return sum;
}

}  // namespace unicursal::core
