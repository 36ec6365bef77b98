// What lets a descent move many points together. A gradient knows its neighbourhood only: strands that lie a
// tenth too dense over half an island are each content with their neighbours, and L-BFGS needs hundreds of
// steps to spread them. Here a field over scattered points gets back, added to it, its own sums over grids of
// ever wider meshes: M = 1 + strength · Σ P Pᵀ, with P the bilinear interpolation from one grid (J. Bramble,
// J. Pasciak and J. Xu 1990, "Parallel multilevel preconditioners"). M is symmetric and positive definite, so
// that it can stand before L-BFGS in the place of the unit matrix. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/numeric/parallel.hpp"
#include "core/numeric/vec2.hpp"

namespace unicursal::core {

class LongWaves {
 public:
  /// None: M = 1.
  LongWaves() = default;
  /// For a field at these points. The finest grid's meshes are `finest` mm, those of every further one twice
  /// as wide, up to the size of all points.
  LongWaves(const std::vector<Vec2>& points, double finest, double strength);

  bool empty() const { return places_.empty(); }
  /// Multiplies the field by M. Precondition: as many vectors as points. The same for any number of workers.
  void apply(std::vector<Vec2>& field, Workers* workers = nullptr) const;

 private:
  struct Place {
    std::uint32_t node;  ///< of the finest grid, left below the point
    float x, y;          ///< from there, in meshes
  };
  struct Grid {
    std::size_t columns, rows;  ///< of nodes
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
