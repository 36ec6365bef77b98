#include "firmware_gcode/sliced/feature.hpp"

#include <array>
#include <cstddef>

namespace unicursal::gcode {
namespace {

struct Traits {
  const char* name;
  bool seen;
  double weight;
};

// A wrong colour in an inner wall shines through a little; infill, support and what is thrown away take
// changes gladly, in this order.
constexpr std::array<Traits, 11> traits{{{"outer wall", true, 1},
                                         {"inner wall", false, 0.05},
                                         {"top surface", true, 1},
                                         {"bottom surface", true, 1},
                                         {"solid infill", false, 0.02},
                                         {"sparse infill", false, 0.01},
                                         {"support", false, 0.005},
                                         {"skirt or brim", false, 0.002},
                                         {"wipe tower", false, 0.001},
                                         {"the slicer's own lines", false, 0.002},
                                         {"bead", true, 1}}};

}  // namespace

const char* name(Feature feature) {
  return traits[static_cast<std::size_t>(feature)].name;
}
bool is_seen(Feature feature) {
  return traits[static_cast<std::size_t>(feature)].seen;
}
bool is_aside(Feature feature) {
  return feature == Feature::aside || feature == Feature::tower || feature == Feature::custom;
}

double weight(Feature feature) {
  return traits[static_cast<std::size_t>(feature)].weight;
}

}  // namespace unicursal::gcode
