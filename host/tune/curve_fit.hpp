// Computes the dead volume, the mixing volume and the tanks of a nozzle from the colour of a strip, as it was
// measured all along the bead. mm³. The model is that of transition_fit.hpp; here the whole curve is fitted.
//
// Colours do not change in proportion to shares: a little red shows in white at once, a little white in red
// hardly. Three lines whose shares of the change are known (`perception`) show how a colour answers to a
// share, in the same photo. Between them, logit(colour) − logit(share) is interpolated; for filaments that
// mix after the law of Beer and Lambert it is a constant. So neither a model of colours nor a calibrated
// camera is needed.
#pragma once

#include <array>
#include <vector>

#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

/// How far the colour has gone from the first mixture's (0) to the second's (1), after the volume `passed`
/// since the switch.
struct CurvePoint {
  double passed = 0;
  double change = 0;
  double trust = 1;  ///< 0: of no use
};

/// The same measure for the reference lines of `perception`, and its standard deviation.
struct CurveAnchors {
  std::array<double, 3> change{};
  std::array<double, 3> doubt{};
};

struct CurveFit {
  Estimate dead, mixing, tanks;  ///< uncertainty: two standard deviations
  double scatter = 0;            ///< of the points around the curve, as a change

  /// The change of colour that the fit foretells.
  double change_after(double passed) const;

  CurveAnchors anchors;
};

/// Throws core::DataError if the points are not the curve of a nozzle, or end before its change does.
/// Precondition: the anchors are between 0 and 1 and ascend.
CurveFit fit_curve(const std::vector<CurvePoint>& points, const CurveAnchors& anchors);

}  // namespace unicursal::host
