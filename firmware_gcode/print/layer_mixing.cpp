#include "firmware_gcode/print/layer_mixing.hpp"

#include <algorithm>

namespace unicursal::gcode {

LayerMixing& LayerMixing::operator+=(const LayerMixing& more) {
  changes += more.changes;
  switches += more.switches;
  passed_over += more.passed_over;
  passed_over_volume += more.passed_over_volume;
  misplaced += more.misplaced;
  wrong += more.wrong;
  crossings += more.crossings;
  short_crossings += more.short_crossings;
  shortest_crossing = std::min(shortest_crossing, more.shortest_crossing);
  return *this;
}

}  // namespace unicursal::gcode
