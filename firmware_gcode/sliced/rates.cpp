#include "firmware_gcode/sliced/rates.hpp"

namespace unicursal::gcode {

bool Rates::take(const SlicedCommand& command) {
  const bool of_speed = command.is('M', 220);
  if (of_speed && command.has('B')) kept_ = speed_;
  if (of_speed && command.has('R')) speed_ = kept_;
  if (!command.valued('S')) return true;  // asks for the present one
  const double percent = command.value('S');
  if (!(percent >= 1 && percent <= 999)) return false;
  (of_speed ? speed_ : flow_) = percent / 100;
  return true;
}

}  // namespace unicursal::gcode
