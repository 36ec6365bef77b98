// motion.png: three diagrams over the time of the print, from the first bead on. Speed of laying beads (mean
// in blue, the fastest instant pale), the volume pushed per second, and the queue (mean moves in blue, the
// fewest in red). Starvations are red lines from top to bottom.
#pragma once

#include "core/picture/image.hpp"
#include "sim/motion/motion_log.hpp"

namespace unicursal::sim {

picture::Image draw_motion(const MotionLog& log);

}  // namespace unicursal::sim
