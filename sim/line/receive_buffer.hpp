// The firmware's serial receive buffer: a ring in which one place always stays free. What does not fit is
// lost without a word, as on the real board (firmware facts: capacity, overrun).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sim/line/wire.hpp"

namespace unicursal::sim {

class ReceiveBuffer {
 public:
  static constexpr std::size_t size = 128;           ///< bytes
  static constexpr std::size_t capacity = size - 1;  ///< bytes that can really wait

  /// Takes the byte if it fits; otherwise it is counted as lost, and the next one marked as damaged.
  void push(WireByte byte);
  std::optional<WireByte> pop();
  /// Forgets everything that waits, as the firmware does when a line is damaged.
  void flush();

  bool empty() const { return used_ == 0; }
  std::size_t room() const { return capacity - used_; }
  std::uint64_t lost() const { return lost_; }        ///< bytes that found no room
  std::uint64_t flushed() const { return flushed_; }  ///< bytes that were thrown away by flush()

 private:
  std::array<WireByte, size> bytes_{};
  std::size_t first_ = 0, used_ = 0;
  bool gap_ = false;  ///< bytes were lost behind the last one taken
  std::uint64_t lost_ = 0, flushed_ = 0;
};

}  // namespace unicursal::sim
