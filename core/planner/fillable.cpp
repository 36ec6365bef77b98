#include "core/planner/fillable.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::core {
namespace {

// In bead widths, or their squares.
constexpr double arc_tolerance = 0.005;  ///< of rounded offsets
constexpr double inner_margin = 0.06;    ///< between a region's border and its domain
constexpr double corner_area = 0.25;     ///< a thin piece of no more than this is a corner, not a spike
constexpr double thin_piece = 1.5;       ///< a piece narrower than two beads counts as thin above this area
constexpr double thin_share = 0.04;      ///< a region with a larger share of thin area is thin
constexpr double least_domain = 1e-3;    ///< a smaller domain, or hole of one, is rounding dust

Region without_thin_pieces(const Polygon& island, const Region& thin, double least_area) {
  Region cut;
  for (const Polygon& piece : thin) {
    if (area(piece) > least_area) cut.push_back(piece);
  }
  if (cut.empty()) return {island};
  return subtract({island}, cut);
}

Region domains_of(const Region& region, double half_width, double w) {
  Region domains = offset(offset(region, -half_width, arc_tolerance * w), half_width - inner_margin * w,
                          arc_tolerance * w);
  const double least = least_domain * w * w;
  std::erase_if(domains, [&](const Polygon& domain) { return area(domain) < least; });
  // Removes holes that remain where growing back closes a gap; a hole around a real one has at least the
  // margin's width.
  for (Polygon& domain : domains)
    std::erase_if(domain.holes, [&](const Ring& hole) { return std::abs(signed_area(hole)) < least; });
  return domains;
}

bool mostly_thin(const Polygon& region, double w) {
  double thin = 0;
  for (const Polygon& piece : subtract({region}, opened({region}, w, arc_tolerance * w))) {
    if (area(piece) > thin_piece * w * w) thin += area(piece);
  }
  return thin > thin_share * area(region);
}

/// Pairs regions with the domains inside them. A region with several domains is reduced to the surroundings
/// of each domain, so that their curves cannot meet.
void pair_up(const Region& regions, double half_width, double w, std::vector<FillableRegion>& result) {
  for (const Polygon& region : regions) {
    const Region domains = domains_of({region}, half_width, w);
    if (domains.size() == 1) {
      result.push_back({region, domains.front(), mostly_thin(region, w)});
      continue;
    }
    if (domains.empty()) continue;
    // Both offsets that made a domain may have gone a tolerance too far.
    double margin = (inner_margin - 2 * arc_tolerance) * w;
    Region surroundings = offset(domains, margin, arc_tolerance * w);
    for (; surroundings.size() != domains.size() && margin > 1e-4 * w; margin /= 2) {
      surroundings = offset(domains, margin / 2, arc_tolerance * w);
    }
    if (surroundings.size() != domains.size()) continue;
    for (const Polygon& piece : surroundings) {
      const auto domain = std::find_if(domains.begin(), domains.end(),
                                       [&](const Polygon& d) { return contains(piece, d.outer.front()); });
      if (domain != domains.end()) result.push_back({piece, *domain, mostly_thin(piece, w)});
    }
  }
}

}  // namespace

Fillable fillable(const Polygon& island, double bead_width, double half_width) {
  const double w = bead_width;
  const Region thin = subtract({island}, opened({island}, half_width, arc_tolerance * w));
  Fillable result;
  pair_up(without_thin_pieces(island, thin, corner_area * w * w), half_width, w, result.regions);
  double filled = 0;
  for (const FillableRegion& region : result.regions) filled += area(region.region);
  result.too_thin = std::max(area(island) - filled, 0.0);
  return result;
}

}  // namespace unicursal::core
