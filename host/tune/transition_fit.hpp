// Computes the dead and the mixing volume of a nozzle from three readings of its response to a change of
// mixture. mm³.
//
// Model: for the dead volume D nothing changes; then the new mixture arrives as through k stirred tanks in
// series. k is unknown; real nozzles behave like 1 to 6, fractions included. The mixing volume M is what
// passes from the first trace to 95 %, as in the profile. A share p of the change has arrived after D +
// M·q(k, p) / q(k, 0.95), where q is the quantile of the gamma distribution of shape k.
//
// An eye does not see the first trace, only `perception.began` of the change. By how much the first trace
// comes earlier depends on k: by 2 to 25 % of M. The place where half of the change has arrived determines k
// well enough; without it M remains uncertain by about 13 %.
//
// The fit finds all D, M and k that agree with the readings, each of which is known to a tick. The result is
// the middle of their range, and the uncertainty is half of that range.
#pragma once

#include <optional>

namespace unicursal::host {

/// The shares of the change at the three readings. The strip shows reference lines of exactly these mixtures,
/// so that readings do not depend on who looks.
struct Perception {
  double began = 0.05;
  double half = 0.5;
  double stopped = 0.95;
};
inline constexpr Perception perception;

/// The volume that has passed since the switch lies between these values.
struct VolumeRange {
  double least = 0, greatest = 0;
};

struct ReadVolumes {
  VolumeRange began, stopped;
  std::optional<VolumeRange> half;
};

struct Estimate {
  double value = 0;
  double uncertainty = 0;  ///< the true value lies within value ± uncertainty, if the readings are right
};

struct Transition {
  Estimate dead, mixing;
  /// Factor by which the ranges had to be widened until a nozzle agreed with them; 1: the readings agree.
  double widened = 1;
};

/// Throws core::DataError if no nozzle can cause these readings.
Transition fit_transition(const ReadVolumes& read);

/// The volume, in units of one tank, after which a share `p` (0 < p < 1) of a change has come through `tanks`
/// ≥ 1 tanks in series.
double gamma_quantile(double tanks, double p);

}  // namespace unicursal::host
