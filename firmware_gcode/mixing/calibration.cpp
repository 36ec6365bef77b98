#include "firmware_gcode/mixing/calibration.hpp"

namespace unicursal::gcode {

CalibratedMixture calibrated(const Mixture& wanted, const std::array<double, max_feeders>& factors,
                             const Dialect& dialect) {
  std::array<double, max_feeders> shares = wanted.shares();
  for (std::size_t i = 0; i < max_feeders; ++i) shares[i] *= factors[i];
  const Mixture written = dialect.as_written(Mixture(shares));
  shares = written.shares();
  double fed = 0;  // mm by 1 mm of E
  for (std::size_t i = 0; i < max_feeders; ++i) fed += shares[i] /= factors[i];
  return {written, Mixture(shares), 1 / fed};
}

}  // namespace unicursal::gcode
