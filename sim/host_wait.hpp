// What a host may say on the control socket (sim/lockstep.hpp): `wait UNTIL BYTES`. UNTIL in ns since
// power-up, −1 for ever; BYTES that it has written in all.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace unicursal::sim {

struct HostWait {
  double until = 0;         ///< s; infinite for ever
  std::uint64_t bytes = 0;  ///< written by the host

  bool operator==(const HostWait&) const = default;
};

/// Nothing for what is no such message.
std::optional<HostWait> parse_wait(std::string_view message);

}  // namespace unicursal::sim
