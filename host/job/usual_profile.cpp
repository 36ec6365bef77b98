#include "host/job/usual_profile.hpp"

#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "host/files/state_home.hpp"
#include "host/files/whole_file.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

const char* const frame_text =
    R"(# A common desktop frame with three feeders and one nozzle (Diamond hot end), to try models with.
[printer]
name = "common frame, 0.6 mm"
bed = [200.0, 200.0, 200.0]
nozzle = 0.6
bead_width_range = [0.36, 1.6]

[extruder]
feeders = 3
max_flow = 8.0
)";

}  // namespace

std::optional<fs::path> own_profile() {
  fs::path folder;
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  if (config && *config == '/') {
    folder = config;
  } else if (home && *home == '/') {
    folder = fs::path(home) / ".config";
  } else {
    return std::nullopt;
  }
  std::error_code error;
  const fs::path file = folder / "unicursal" / "printer.toml";
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  return file;
}

fs::path common_frame() {
  const std::optional<fs::path> state = state_home();
  if (!state) {
    throw core::FileError("", "",
                          "the folder of profiles is unknown, since neither XDG_STATE_HOME nor HOME is set",
                          "name a profile with --profile");
  }
  const fs::path file = *state / "frames" / "common.toml";
  std::error_code error;
  if (fs::file_size(file, error) != std::string_view(frame_text).size() || error)
    write_whole_file(file, frame_text);
  return file;
}

}  // namespace unicursal::host
