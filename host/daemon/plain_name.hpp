// Names of files and folders that clients may choose.
#pragma once

#include <string>

namespace unicursal::host {

/// Whether a name has 1 to 64 letters, digits, dots, dashes and underscores, the first not a dot or a dash.
bool is_plain_name(const std::string& name);

}  // namespace unicursal::host
