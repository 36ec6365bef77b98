// Third part of the segment diagram: integrals over cells, summed up along the cells' borders (Green). mm,
// mm², mm⁴.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/curve_sites.hpp"
#include "core/geometry/diagram_arc.hpp"

namespace unicursal::core {

struct CellIntegrals {
  double area = 0;           ///< ∫ 1, mm²
  double second_moment = 0;  ///< ∫ dist², mm⁴; the cell's part of E_CVT (13)
};

/// The integrals of the cells that may reach into one piece of the island.
class CellSums {
 public:
  /// `vertices`, ascending: those whose cells, or whose segments' cells, may reach into the piece.
  CellSums(const CurveSites& sites, std::vector<std::size_t> vertices);

  bool has(const CurveSite& site) const;

  /// Adds `weight` times the integrals along a stretch of an arc that has the site's cell on its left.
  /// Precondition: has(site).
  void add(const CurveSite& site, const Arc& arc, double s0, double s1, double weight);

  /// Adds all sums to those of the whole curve: the cells of its vertices and of its segments.
  void add_to(std::vector<CellIntegrals>& points, std::vector<CellIntegrals>& segments) const;

 private:
  std::size_t place(std::size_t vertex) const;

  const CurveSites* sites_;
  std::vector<std::size_t> vertices_;
  std::vector<CellIntegrals> points_, segments_;  ///< in the order of vertices_
};

}  // namespace unicursal::core
