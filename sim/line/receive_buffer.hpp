// The firmware's serial receive buffer: a ring in which one place always stays free. Bytes that do not fit
// are lost silently, as on a real board (sim/README.md, "Marlin 2.1": capacity, overrun).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sim/line/wire.hpp"

namespace unicursal::sim {

class ReceiveBuffer {
 public:
  static constexpr std::size_t size = 128;           ///< Bytes.
  static constexpr std::size_t capacity = size - 1;  ///< Bytes that can wait.

  /// Stores the byte if it fits; otherwise counts it as lost and marks the next stored byte as damaged.
  void push(WireByte byte);
  std::optional<WireByte> pop();
  /// Discards all waiting bytes, as the firmware does when a line is damaged.
  void flush();

  bool empty() const { return used_ == 0; }
  std::size_t room() const { return capacity - used_; }
  std::uint64_t lost() const { return lost_; }        ///< Bytes that did not fit.
  std::uint64_t flushed() const { return flushed_; }  ///< Bytes that flush() discarded.

 private:
  std::array<WireByte, size> bytes_{};
  std::size_t first_ = 0, used_ = 0;
  bool gap_ = false;  ///< Whether bytes were lost after the last stored one.
  std::uint64_t lost_ = 0, flushed_ = 0;
};

}  // namespace unicursal::sim
