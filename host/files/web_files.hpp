// The files of the page (host/web), which the build bundles, packs with gzip and puts into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace unicursal::host {

struct WebFile {
  std::string_view name;    ///< "page.js", without a folder
  std::string_view packed;  ///< its bytes in gzip's format (RFC 1952)
  std::string_view digest;  ///< of the unpacked bytes: 128 bits in hexadecimal
};

/// Empty if the program was built without its page (UNICURSAL_WEB=OFF).
const std::vector<WebFile>& web_files();
/// Null if that file is not among them.
const WebFile* web_file(std::string_view name);

/// Its bytes as they were before packing.
std::string unpacked(const WebFile& file);

}  // namespace unicursal::host
