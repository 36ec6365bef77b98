#include "core/planner/with_perimeters.hpp"

#include <algorithm>
#include <utility>

#include "core/curve/join.hpp"
#include "core/curve/perimeters.hpp"

namespace unicursal::core {
namespace {

// In bead widths, or their squares.
constexpr double arc_tolerance = 0.005;  ///< of rounded offsets
constexpr double least_inner = 0.8;      ///< least width of the fill behind a band
constexpr double hair = 0.02;            ///< half the width of differences that are rounding
constexpr double dust = 0.02;            ///< smaller pieces are rounding
constexpr double most_thin = 0.002;      ///< share of a piece's area that may be left out
// Prices of joints: the outermost contour is opened only once if possible, and borders are crossed even more
// rarely.
constexpr double price_of_outermost = 1, price_of_border = 10;

/// A closed curve on its way to be joined.
struct Strand {
  Curve curve;
  std::size_t piece = 0;
  bool outermost = false;
};

/// The contours of a piece, and the area that they leave.
struct Share {
  std::vector<Strand> strands;
  Region inside;
  int depth = 0;  ///< contours laid
};

void add(Share& share, const Polygon& region, int count, const PerimeterOptions& options) {
  Perimeters laid = perimeters(region, count, options.bead_width, 2 * options.half_width);
  for (std::size_t k = 0; k < laid.rings.size(); ++k) {
    for (Curve& ring : laid.rings[k]) share.strands.push_back({std::move(ring), 0, k == 0});
  }
  share.depth = std::max(share.depth, static_cast<int>(laid.rings.size()));
  share.inside.insert(share.inside.end(), laid.inside.begin(), laid.inside.end());
}

Share along_whole_border(const Polygon& island, const PerimeterOptions& options) {
  Share share;
  add(share, island, options.count, options);
  return share;
}

/// The part of a region that a disc reaches, without the hairs along edges that rounding leaves and that
/// would connect separate areas.
Region disc_reach(const Region& region, double radius, double w) {
  return offset(offset(region, -radius, arc_tolerance * w), radius, arc_tolerance * w);
}

/// Lays loops in the part of the piece along the island's outline; the fill gets the places where no loop
/// fits.
Share along_share_of_outline(const Polygon& piece, const Polygon& island, const PerimeterOptions& options) {
  const double w = options.bead_width;
  const int loops = (options.count + 1) / 2;
  const Region deep = intersect({piece}, offset({island}, -2 * loops * w, arc_tolerance * w));
  Region inner = disc_reach(deep, least_inner * w / 2, w);
  Share share;
  for (const Polygon& part : disc_reach(subtract({piece}, inner), hair * w, w)) {
    const std::size_t before = share.strands.size();
    add(share, part, loops, options);
    if (share.strands.size() > before) continue;
    share.inside.pop_back();
    inner = unite(inner, offset({part}, hair * w, arc_tolerance * w));
  }
  for (const Polygon& rest : intersect(inner, {piece})) share.inside.push_back(rest);
  return share;
}

/// Adds the curves that fill the inside. Returns false if that fails.
bool fill_inside(Share& share, double most_left_out, const PerimeterOptions& options,
                 const FillFunction& fill) {
  const double w = options.bead_width;
  double left_out = 0;
  for (const Polygon& region : share.inside) {
    if (share.depth > 0 && !worth_a_curve(region, w)) continue;
    const Fillable parts = fillable(region, w, options.half_width);
    left_out += parts.too_thin;
    for (const FillableRegion& part : parts.regions) {
      std::optional<Curve> curve = fill(part);
      if (!curve) return false;
      share.strands.push_back({std::move(*curve), 0, false});
    }
  }
  return left_out <= most_left_out;
}

std::optional<Curve> joined_strands(std::vector<Strand> strands, const Polygon& island, double w) {
  std::vector<Curve> curves;
  for (Strand& strand : strands) curves.push_back(std::move(strand.curve));
  const JointPrice price = [&](std::size_t i, std::size_t j) {
    return price_of_outermost * (strands[i].outermost + strands[j].outermost) +
           (strands[i].piece != strands[j].piece ? price_of_border : 0);
  };
  return joined(std::move(curves), island, w, price);
}

}  // namespace

std::optional<Outlined> with_perimeters(const Polygon& island, const std::vector<Polygon>& pieces,
                                        const PerimeterOptions& options, const FillFunction& fill) {
  std::vector<Strand> strands;
  int depth = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    Share share = pieces.size() == 1 ? along_whole_border(island, options)
                                     : along_share_of_outline(pieces[k], island, options);
    if (!fill_inside(share, most_thin * area(pieces[k]), options, fill)) return std::nullopt;
    depth = std::max(depth, share.depth);
    for (Strand& strand : share.strands) {
      strand.piece = k;
      strands.push_back(std::move(strand));
    }
  }
  std::optional<Curve> curve = joined_strands(std::move(strands), island, options.bead_width);
  if (!curve) return std::nullopt;
  return Outlined{std::move(*curve), pieces.size() == 1 ? depth : 2 * depth};
}

}  // namespace unicursal::core
