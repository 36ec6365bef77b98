#include "firmware_gcode/mixing/calibration.hpp"

namespace unicursal::gcode {

CalibratedMixture calibrated(const Mixture& wanted, const PerFeeder& factors, const Dialect& dialect) {
  Shares shares = wanted.shares();
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] *= factors[i];
  const Mixture written = dialect.as_written(Mixture(shares));
  shares = written.shares();
  double fed = 0;  // mm per mm of E
  for (std::size_t i = 0; i < shares.size(); ++i) fed += shares[i] /= factors[i];
  return {written, Mixture(shares), 1 / fed};
}

}  // namespace unicursal::gcode
