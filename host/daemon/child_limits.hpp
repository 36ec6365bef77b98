// What a child of the daemon may take: it has the lowest priority, goes with the daemon, goes first when
// memory runs out, and leaves no dump.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <optional>

namespace unicursal::host {

struct ChildLimits {
  int death_signal = 0;                 ///< comes when the daemon ends
  std::optional<std::uint64_t> memory;  ///< address space, bytes; not with the address sanitizer
  std::optional<rlim_t> soft_seconds;   ///< of the processor; then SIGXCPU comes, by default its end
  rlim_t grace_seconds = 0;             ///< behind these it is killed
  std::optional<rlim_t> largest_file;   ///< bytes
};

/// Applies them to this process. Makes system calls only, so that it may stand between fork() and execv().
void take_on(const ChildLimits& limits);

}  // namespace unicursal::host
