#include "host/job/sliced_file.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "host/job/job_error.hpp"

namespace unicursal::host {
namespace {

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

}  // namespace

bool is_sliced_file(const std::filesystem::path& file) {
  static constexpr std::array endings{".gcode", ".gco", ".gc", ".g"};
  return std::find(endings.begin(), endings.end(), ending_of(file)) != endings.end();
}

void refuse_binary_gcode(const std::filesystem::path& file) {
  if (ending_of(file) != ".bgcode") return;
  throw JobError(
      file.string(), "", "is binary G-code, which cannot be read",
      "switch off \"Supports binary G-code\" in the slicer's printer settings, and export it again");
}

}  // namespace unicursal::host
