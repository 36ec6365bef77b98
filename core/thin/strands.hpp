// One closed curve along the medial axis of thin places and through the curves of thick ones. mm.
//
// A closed curve is the border of the region that it encloses, so that region is what is put together here:
// - A ring of the axis that one bead can fill becomes a single strand (the paper's Figure 18, right): what it
//   encloses is added whole.
// - Everywhere else the strand runs there and back. A band of half the place's width along the axis is added
//   (or taken away inside such a ring), so that either strand fills half of the place.
// - Where half of the place is narrower than the nozzle can lay, the two strands lie almost on each other,
//   on the axis: the first one lays all, the second one is the way back and lays nothing (OneWay).
// - What the curve of a thick place encloses is added, and a band joins it to the axis.
// Bands that would close a ring are cut in the middle, so that the whole has a single border.
#pragma once

#include <optional>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/region.hpp"
#include "core/thin/thin_places.hpp"

namespace unicursal::core {

/// A stretch of the axis with two strands on it, of which the one that runs forwards lays everything.
struct OneWay {
  std::vector<Vec2> axis;
  double apart = 0;  ///< distance of the strands from the axis
};

struct ThinCurve {
  Curve curve;
  std::vector<OneWay> one_way;
};

struct StrandWidths {
  double bead = 0;         ///< as asked for
  double least = 0;        ///< of a strand; a place that is narrower gets none
  double most_single = 0;  ///< of a ring that gets a single strand
  double most_of_two = 0;  ///< of each of two strands there and back; a wider place gets four
};

/// Whether four strands have room in all thin places in which two would be too wide. Else the places are to
/// be looked for with a smaller width.
bool have_room(const Polygon& region, const ThinPlaces& places, const StrandWidths& widths);

/// Returns nullopt if the curves cannot be joined, or if all thin places are too narrow. `thick_curves` are
/// simple and fill `places.thick`. The caller checks the result.
std::optional<ThinCurve> lay_strands(const Polygon& region, const ThinPlaces& places,
                                     const std::vector<Curve>& thick_curves, const StrandWidths& widths);

/// Moves the areas of strands that lead back to the strands beside them, so that those lead back empty.
void empty_ways_back(const Curve& curve, const std::vector<OneWay>& one_way, std::vector<double>& areas);

}  // namespace unicursal::core
