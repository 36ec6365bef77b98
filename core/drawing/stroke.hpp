// The area that a pen of some width covers along a line (SVG 1.1, section 11.4): caps, joins, dashes. All
// lengths in one unit, by convention mm. Departures: the joins `arcs` and `miter-clip` of SVG 2 are drawn as
// `miter`.
#pragma once

#include <vector>

#include "core/drawing/outline.hpp"

namespace unicursal::core {

enum class Cap { butt, round, square };
enum class Join { miter, round, bevel };

struct StrokeStyle {
  double width = 1;
  Cap cap = Cap::butt;
  Join join = Join::miter;
  double miter_limit = 4;      ///< length of a miter over the width, above which it is cut off
  std::vector<double> dashes;  ///< lengths of dashes and gaps in turn; empty: an uninterrupted line
  double dash_offset = 0;      ///< how far into the pattern the line begins
};

/// The line cut into its dashes. Throws Malformed if they are more than a million.
std::vector<Subpath> dashed(const std::vector<Subpath>& line, const StrokeStyle& style);

/// Closed rings; the stroke is where their winding numbers are not zero. Curves of the pen's edge are within
/// `flattening` of their chords. The dashes of `style` are not applied. Throws Malformed if
/// the rings have more than 2 million points.
std::vector<Ring> stroke_rings(const std::vector<Subpath>& line, const StrokeStyle& style);

}  // namespace unicursal::core
