// How a mixing nozzle answers a change of mixture, and what three readings say of its volumes.
//
// Model: nothing comes for the dead volume D; then the new mixture comes as through stirred tanks in a row,
// whose number k nobody knows (real nozzles behave like 1 to 6, and fractions). The mixing volume M is what
// passes from the first trace to 95 % (the words of the profile). A share p of the change has come when
// D + M·q(k, p) / q(k, 0.95) has passed; q is the quantile of the gamma distribution of shape k.
//
// An eye does not see the first trace, but `perception.began` of the change. How long before that the first
// trace came depends on k: from 2 to 25 % of M. The place where half of the change has come tells k well
// enough; without it M stays uncertain by about 13 %.
//
// All values of D, M and k that agree with the readings are kept, each reading being known to a tick.
// The answer is the middle of what they span, its uncertainty half of the span. mm³.
#pragma once

#include <optional>

namespace unicursal::host {

/// Shares of the change that the three readings stand for. The strip shows lines of these very mixtures to
/// compare with, so that they do not depend on who looks.
struct Perception {
  double began = 0.05;
  double half = 0.5;
  double stopped = 0.95;
};
inline constexpr Perception perception;

/// What may have passed since the switch.
struct VolumeRange {
  double least = 0, greatest = 0;
};

struct ReadVolumes {
  VolumeRange began, stopped;
  std::optional<VolumeRange> half;
};

struct Estimate {
  double value = 0;
  double uncertainty = 0;  ///< the truth lies within so much of the value, if the readings are right
};

struct Transition {
  Estimate dead, mixing;
  /// By how many times the ranges had to be widened until a nozzle fitted; 1: the readings agree.
  double widened = 1;
};

/// Throws core::DataError for readings that no nozzle can cause.
Transition fit_transition(const ReadVolumes& read);

/// What has passed, in units of a tank, when a share `p` (0 < p < 1) has come through `tanks` tanks, at
/// least 1, in a row.
double gamma_quantile(double tanks, double p);

}  // namespace unicursal::host
