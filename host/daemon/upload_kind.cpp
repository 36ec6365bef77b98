#include "host/daemon/upload_kind.hpp"

#include <algorithm>

#include "core/model/file_kind.hpp"
#include "core/text/printable.hpp"
#include "core/text/wording.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/refused.hpp"
#include "host/job/sliced_file.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_sent = 255;  ///< bytes; no file system has longer names
constexpr std::size_t longest_kept = 56;   ///< bytes; a number may be added (job_files.hpp)

std::string ending_of(const fs::path& file) {
  return core::lower(file.extension().string());
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
}

}  // namespace

bool is_queueable(const fs::path& file) {
  return file.extension() == ".toml" || core::is_model_file(file) || is_sliced_file(file);
}

UploadKind upload_kind(const std::string& name) {
  const fs::path file(name);
  if (ending_of(file) == ".toml") return UploadKind::job;
  if (core::is_model_file(file)) return UploadKind::model;
  if (is_sliced_file(file)) return UploadKind::gcode;
  if (ending_of(file) == ".bgcode")
    throw Refused(Why::bad_kind, "binary_gcode",
                  "binary G-code is not read here; switch it off in the slicer's settings of the printer");
  throw Refused(Why::bad_kind,
                "\"" + core::printable(name) +
                    "\" is a sort of file that is not printed here; send G-code (.gcode), a model "
                    "(.stl, .3mf, .obj, .amf, .svg) or a job (.toml)");
}

std::string kept_name(const std::string& sent) {
  const bool has_controls = std::any_of(sent.begin(), sent.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < ' ' || byte == 0x7f;
  });
  if (sent.size() > longest_sent || has_controls)
    throw Refused(
        Why::bad_name,
        "the name of the file is longer than 255 bytes, or holds control characters; rename the file");
  const std::size_t slash = sent.find_last_of("/\\");
  const std::string base = slash == std::string::npos ? sent : sent.substr(slash + 1);
  const std::size_t dot = base.rfind('.');
  const std::string ending = dot == std::string::npos ? "" : core::lower(base.substr(dot));
  std::string stem;
  for (const char c : base.substr(0, dot)) {
    if (is_plain(c))
      stem += c;
    else if (!stem.empty() && stem.back() != '_')
      stem += '_';
  }
  stem.erase(0, std::min(stem.find_first_not_of(".-_"), stem.size()));
  stem.resize(std::min(stem.size(), longest_kept - std::min(ending.size(), longest_kept)));
  stem.erase(stem.find_last_not_of("._") + 1);
  const std::string name = (stem.empty() ? "unnamed" : stem) + ending;
  if (ending.size() < 2 || !is_plain_name(name))
    throw Refused(Why::bad_name, "the file has no name that says what it is; name it for example leaf.stl");
  return name;
}

}  // namespace unicursal::host
