// The message that a host sends on the control socket (sim/lockstep.hpp): `wait UNTIL BYTES`. UNTIL is in ns
// since power-up, or −1 for ever; BYTES is the number of bytes that the host has written so far.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace unicursal::sim {

struct HostWait {
  double until = 0;         ///< Printer time, s; infinity = for ever.
  std::uint64_t bytes = 0;  ///< Bytes that the host has written so far.

  bool operator==(const HostWait&) const = default;
};

/// Returns nullopt if the message is malformed.
std::optional<HostWait> parse_wait(std::string_view message);

}  // namespace unicursal::sim
