// A square lattice of sample points over a polygon, for integrals over the island: each sample stands for
// the piece of its square that lies inside, with that piece's exact area and centroid. mm, mm².
//
// Know its limits: an axis-aligned lattice resonates with parallel folds, so callers rotate the polygon by
// an irrational angle first, and the exact segment diagram, never the lattice, decides a final figure.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct Lattice {
  Vec2 origin{0, 0};  ///< lower left corner of square (0, 0)
  double pitch = 0;   ///< side of a square
  std::size_t columns = 0, rows = 0;
  // One entry per square, row by row. Positions are relative to the origin.
  std::vector<float> x, y;
  std::vector<float> weight;  ///< mm²; 0 where the square lies outside

  std::size_t size() const { return weight.size(); }
  double total_weight() const;
  Vec2 position(std::size_t k) const { return origin + Vec2(x[k], y[k]); }
};

/// Precondition: pitch > 0. Throws std::length_error beyond 2^31 squares.
Lattice sample(const Polygon& polygon, double pitch);

}  // namespace unicursal::core
