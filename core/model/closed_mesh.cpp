#include "core/model/closed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/model/edge_pairing.hpp"
#include "core/model/hole.hpp"
#include "core/model/mesh_shells.hpp"
#include "core/model/stitch.hpp"
#include "core/model/weld.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double stitch_reach = 10;  ///< in weld distances: how far a vertex may lie beside an edge
constexpr double most_doubt = 0.01;  ///< of the volume
constexpr double least_sheet = 1.0;  ///< mm²: smaller surfaces without thickness are not worth a note

std::string near(const Vec3& p) {
  return fmt::format("near ({:.4g}, {:.4g}, {:.4g}) mm", p.x(), p.y(), p.z());
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

class Mender {
 public:
  Mender(const std::vector<Triangle>& triangles, const std::string& name, Warnings& warnings)
      : name_(name), warnings_(warnings), mesh_(indexed(triangles)) {}

  ClosedMesh mend() {
    const std::size_t collapsed = drop_collapsed(mesh_);
    borders_ = pair_edges(mesh_);
    if (!borders_.empty()) {
      stop_point();
      weld_and_stitch();
      stop_point();
      turn_facets();
      close_holes();
    }
    stop_point();
    finish_shells();
    if (collapsed > 0) note(counted(collapsed, "facet", "facets") + " without area were left out");
    return std::move(mesh_);
  }

 private:
  void note(const std::string& what) { warnings_.add(name_ + ": " + what); }

  [[noreturn]] void refuse(const std::string& place, const std::string& problem,
                           const std::string& remedy) const {
    throw ModelError(name_, place, problem, remedy);
  }

  Vec3 middle(MeshEdge h) const { return (mesh_.vertices[mesh_.from(h)] + mesh_.vertices[mesh_.to(h)]) / 2; }

  void weld_and_stitch() {
    const double distance = weld_distance(mesh_);
    if (const std::size_t moved = weld(mesh_, distance); moved > 0) {
      drop_collapsed(mesh_);
      borders_ = pair_edges(mesh_);
      note(fmt::format("{} within {:.2g} mm of another were joined to it",
                       counted(moved, "vertex", "vertices"), distance));
    }
    if (const std::size_t copies = drop_copies(mesh_, borders_); copies > 0) {
      borders_ = pair_edges(mesh_);
      note(counted(copies, "copy of a facet was", "copies of facets were") + " left out");
    }
    if (borders_.empty()) return;
    const Vec3 place = middle(borders_.front());
    if (const std::size_t stitches = stitch(mesh_, borders_, stitch_reach * distance); stitches > 0) {
      drop_collapsed(mesh_);
      borders_ = pair_edges(mesh_);
      note(fmt::format("edges that lie on each other were stitched at {}, the first {}",
                       counted(stitches, "vertex", "vertices"), near(place)));
    }
  }

  void turn_facets() {
    if (borders_.empty()) return;
    const Agreement agreement = agree(mesh_);
    if (!agreement.two_sided) {
      refuse(near(middle(borders_.front())), "the surface has only one side, so it bounds no solid",
             "model it again");
    }
    borders_ = pair_edges(mesh_);
    if (agreement.turned > 0)
      note(counted(agreement.turned, "facet that faced the wrong way was",
                   "facets that faced the wrong way were") +
           " turned");
  }

  void close_holes() {
    if (borders_.empty()) return;
    const std::size_t open = borders_.size();
    std::vector<Hole> holes = fill_holes(mesh_, borders_);
    borders_ = pair_edges(mesh_);
    if (holes.empty() || !borders_.empty()) {
      refuse("", fmt::format("the mesh is open: {} edges have only one facet", open),
             "close its holes in a modelling or mesh repair program");
    }
    const Hole& largest = *std::max_element(holes.begin(), holes.end(),
                                            [](const Hole& a, const Hole& b) { return a.area < b.area; });
    double doubt = 0;
    for (const Hole& hole : holes) doubt += hole.doubt;
    double volume = 0;
    for (const Shell& shell : shells_of(mesh_)) volume += shell.thin() ? 0 : std::abs(shell.volume);
    if (volume > 0 && doubt > most_doubt * volume) {
      const Hole& worst = *std::max_element(holes.begin(), holes.end(),
                                            [](const Hole& a, const Hole& b) { return a.doubt < b.doubt; });
      refuse(near(worst.place),
             fmt::format(
                 "the mesh is open: {} edges have only one facet, and how to close the hole of {} edges and "
                 "{:.3g} mm² here would be a guess",
                 open, worst.edges, worst.area),
             "close it in a modelling or mesh repair program");
    }
    note(fmt::format("{} closed, the largest of {:.3g} mm² {}",
                     counted(holes.size(), "hole was", "holes were"), largest.area, near(largest.place)));
  }

  void finish_shells() {
    std::vector<Shell> shells = shells_of(mesh_);
    if (const std::size_t turned = turn_shells(mesh_, shells); turned > 0)
      note(counted(turned, "shell was", "shells were") + " inside out and turned");
    const bool solid = std::any_of(shells.begin(), shells.end(), [](const Shell& s) { return !s.thin(); });
    if (!solid) {
      throw NothingEnclosed(name_, "", "the mesh encloses no volume",
                            "give its surface a thickness in a modelling program, or export it again");
    }
    for (const Shell& shell : shells) {
      if (!shell.thin() || shell.area / 2 < least_sheet) continue;
      note(fmt::format("a surface of {:.3g} mm² without thickness encloses nothing {}", shell.area / 2,
                       near(mesh_.vertices[mesh_.facets[shell.facets.front()][0]])));
    }
  }

  const std::string& name_;
  Warnings& warnings_;
  ClosedMesh mesh_;
  std::vector<MeshEdge> borders_;
};

}  // namespace

ClosedMesh closed_mesh(const std::vector<Triangle>& triangles, const std::string& name, Warnings& warnings) {
  return Mender(triangles, name, warnings).mend();
}

}  // namespace unicursal::core
