// A sound job and profile that tests spoil in one place each.
#pragma once

#include <string>

#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

inline constexpr const char* sample_profile = R"([printer]
name = "Test bench"
firmware = "marlin"
baud = 115200
bed = [120.0, 100.0, 80.0]
nozzle = 0.6
bead_width_range = [0.4, 1.2]

[extruder]
feeders = 3
max_flow = 5.0
)";

inline constexpr const char* sample_job = R"(printer = "bench.toml"

[part]
file = "plate.svg"
height = 0.4
layer_height = 0.2
bead_width = 1.0
flow = 3.0

[[zone]]
select = "#0000ff"
pattern = "isotropic"
mixture = "sea"

[[zone]]
select = "#ff0000"
pattern = "none"
mixture = "sun"

[mixture]
sea = [0.6, 0.0, 0.2]
sun = [0.0, 1.0, 1.0]
)";

/// A print of 2000 layers. A test that stops or kills a print takes these, since nobody sees their end: on a
/// busy computer a print of a few seconds is over before its test has typed what stops it.
inline std::string tall_profile() {
  return replaced(sample_profile, "80.0]", "400.0]");
}
inline std::string tall_job() {
  return replaced(sample_job, "height = 0.4", "height = 400.0");
}

/// 20 x 16 mm, the right 8 mm of it in another colour.
inline constexpr const char* sample_drawing = R"(<svg xmlns="http://www.w3.org/2000/svg"
  width="20mm" height="16mm" viewBox="0 0 20 16">
  <rect x="0" y="0" width="20" height="16" fill="#0000ff"/>
  <rect x="12" y="0" width="8" height="16" fill="#ff0000"/>
</svg>
)";

}  // namespace unicursal::test
