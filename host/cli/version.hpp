// The version, and the commit that the program was built from.
#pragma once

namespace unicursal::host {

/// "0.1.0 (commit 046a1314ed, 2026-11-30)" with the date of the commit in UTC. In sources whose commit is not
/// known (host/packaging/commit.cmake) the number alone.
extern const char* const version;

}  // namespace unicursal::host
