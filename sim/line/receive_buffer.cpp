#include "sim/line/receive_buffer.hpp"

#include <algorithm>

namespace unicursal::sim {

void ReceiveBuffer::push(std::string_view bytes) {
  const std::size_t fits = std::min(bytes.size(), room());
  for (const char byte : bytes.substr(0, fits)) bytes_[(first_ + used_++) % size] = byte;
  lost_ += bytes.size() - fits;
}

std::optional<char> ReceiveBuffer::pop() {
  if (empty()) return std::nullopt;
  const char byte = bytes_[first_];
  first_ = (first_ + 1) % size;
  --used_;
  return byte;
}

void ReceiveBuffer::flush() {
  flushed_ += used_;
  used_ = 0;
}

}  // namespace unicursal::sim
