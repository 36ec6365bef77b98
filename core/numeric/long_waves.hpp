// A multilevel preconditioner, with which a descent moves many points together. mm.
//
// A gradient knows only its neighbourhood. Strands that are a tenth too dense over half an island are each in
// balance with their neighbours, and L-BFGS needs hundreds of steps to spread them. The preconditioner adds
// to a field over scattered points its own sums over grids with ever wider meshes: M = 1 + strength · Σ P Pᵀ,
// where P is the bilinear interpolation from one grid (J. Bramble, J. Pasciak and J. Xu 1990, "Parallel
// multilevel preconditioners"). M is symmetric and positive definite, so L-BFGS can start from it instead of
// the identity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/numeric/parallel.hpp"
#include "core/numeric/vec2.hpp"

namespace unicursal::core {

class LongWaves {
 public:
  /// M = 1: changes nothing.
  LongWaves() = default;
  /// For a field at these points. The meshes of the finest grid are `finest` mm wide. Each further grid has
  /// meshes twice as wide, up to the extent of the points.
  LongWaves(const std::vector<Vec2>& points, double finest, double strength);

  bool empty() const { return places_.empty(); }
  /// Multiplies the field by M. Precondition: one vector per point. Any number of workers gives the same
  /// bytes.
  void apply(std::vector<Vec2>& field, Workers* workers = nullptr) const;

 private:
  struct Place {
    std::uint32_t node;  ///< index in the finest grid of the node to the lower left of the point
    float x, y;          ///< offset from that node, in meshes
  };
  struct Grid {
    std::size_t columns, rows;  ///< counts of nodes
  };
  using Field = std::vector<Vec2>;

  Field gathered(const Field& field) const;
  static Field coarser(const Field& nodes, const Grid& from, const Grid& to);
  static void add_finer(Field& nodes, const Grid& at, const Field& coarse, const Grid& of);

  std::vector<Place> places_;
  std::vector<Grid> grids_;  ///< the finest first
  double strength_ = 0;
};

}  // namespace unicursal::core
