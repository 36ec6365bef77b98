// Computes the dead volume, the mixing volume and the tanks of a nozzle from the colour of the whole bead of
// a strip, as it was seen all along. mm³. The model is that of transition_fit.hpp: what comes out is the sum
// of the answers to all switches of the mixture before. So the lanes that fill the nozzle for a reference
// line count as well as the strip itself, and each mixture is seen on many parts of the bed.
//
// How the colour answers to a share (colour_answer.hpp) is fitted together with the nozzle, and so is what
// disturbs the colours: light that the known places do not show, smooth over the bed; a bed that shines
// through some lanes more than through others; and a camera that bends light colours less than dark ones.
#pragma once

#include <filesystem>
#include <vector>

#include "host/tune/colour_answer.hpp"
#include "host/tune/curve_points.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

struct CurveFit {
  Estimate dead, mixing, tanks;  ///< uncertainty: two standard deviations
  double scatter = 0;            ///< of the points around the curve, encoded
  std::vector<Seen> foretold;    ///< the colour of each point
};

/// The first mixture fills the nozzle before the first switch. Throws core::DataError if the points are not
/// the curve of a nozzle, or end before its change does. `file` is that of the photo, for messages.
CurveFit fit_curve(const std::vector<CurvePoint>& points, const std::vector<MixtureSwitch>& switches,
                   const ReferenceColours& references, const std::filesystem::path& file);

}  // namespace unicursal::host
