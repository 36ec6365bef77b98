#include "firmware_gcode/toolpath/chunk.hpp"

#include <algorithm>

namespace unicursal::gcode {

void add(std::vector<MixtureVolume>& volumes, const Mixture& mixture, double volume) {
  const auto same =
      std::find_if(volumes.begin(), volumes.end(), [&](const auto& v) { return v.mixture == mixture; });
  if (same == volumes.end())
    volumes.push_back({mixture, volume});
  else
    same->volume += volume;
}

}  // namespace unicursal::gcode
