#include "host/job/usual_profile.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "core/text/file_bytes.hpp"
#include "host/files/state_home.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/frames.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view common = "diamond-0.6";

}  // namespace

std::optional<fs::path> own_profile_path() {
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
  return folder / "unicursal" / "printer.toml";
}

std::optional<fs::path> own_profile() {
  const std::optional<fs::path> file = own_profile_path();
  std::error_code error;
  if (!file || !fs::is_regular_file(*file, error)) return std::nullopt;
  return file;
}

fs::path common_frame() {
  const std::optional<fs::path> state = state_home();
  if (!state) {
    throw core::FileError("", "",
                          "the folder of profiles is unknown, since neither XDG_STATE_HOME nor HOME is set",
                          "name a profile with --profile");
  }
  const fs::path file = *state / "frames" / fmt::format("{}.toml", common);
  const std::string_view text = frame_named(common)->text;
  std::error_code error;
  if (!fs::is_regular_file(file, error) || core::file_bytes(file) != text) write_whole_file(file, text);
  return file;
}

}  // namespace unicursal::host
