// motion.png: three diagrams over the time of the print, from the first bead on: the speed of laying beads
// (mean in blue, maximum in pale blue), the flow, and the number of queued moves (mean in blue, minimum in
// red). Starvations are vertical red lines.
#pragma once

#include "core/picture/image.hpp"
#include "sim/motion/motion_log.hpp"

namespace unicursal::sim {

picture::Image draw_motion(const MotionLog& log);

}  // namespace unicursal::sim
