// What sort of file somebody sends, whether it can be queued, and under which name it is kept.
#pragma once

#include <filesystem>
#include <string>

namespace unicursal::host {

enum class UploadKind {
  job,    ///< .toml
  model,  ///< printed with the usual settings
  gcode   ///< of a slicer
};

/// Whether a file of this name can be queued.
bool is_queueable(const std::filesystem::path& file);

/// Throws Refused for a file that cannot be queued.
UploadKind upload_kind(const std::string& name);

/// A plain name (plain_name.hpp) for a name that a stranger has sent: without folders, with an ending in
/// lower case, short, and with underscores for everything else. Throws Refused if nothing sensible remains,
/// or if the name holds control characters.
std::string kept_name(const std::string& sent);

}  // namespace unicursal::host
