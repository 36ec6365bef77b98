#include "sim/line/receive_buffer.hpp"

#include <utility>

namespace unicursal::sim {

void ReceiveBuffer::push(WireByte byte) {
  if (room() == 0) {
    ++lost_;
    gap_ = true;
    return;
  }
  byte.damaged = std::exchange(gap_, false) || byte.damaged;
  bytes_[(first_ + used_++) % size] = byte;
}

std::optional<WireByte> ReceiveBuffer::pop() {
  if (empty()) return std::nullopt;
  const WireByte byte = bytes_[first_];
  first_ = (first_ + 1) % size;
  --used_;
  return byte;
}

void ReceiveBuffer::flush() {
  flushed_ += used_;
  used_ = 0;
}

}  // namespace unicursal::sim
