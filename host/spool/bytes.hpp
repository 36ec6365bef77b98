// Numbers and texts as bytes, little-endian on every computer.
#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace unicursal::host {

/// The bytes are not a possible output of their writer.
class DamagedBytes : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ByteWriter {
 public:
  template <class Unsigned>
  ByteWriter& put(Unsigned value) {
    static_assert(std::is_unsigned_v<Unsigned>);
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_ += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
    }
    return *this;
  }
  ByteWriter& put(double value) { return put(std::bit_cast<std::uint64_t>(value)); }
  ByteWriter& put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  /// `bytes` must outlive the reader.
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class Unsigned>
  Unsigned take() {
    static_assert(std::is_unsigned_v<Unsigned>);
    const std::string_view from = raw(sizeof(Unsigned));
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
      const Unsigned byte = static_cast<unsigned char>(from[i]);
      value = static_cast<Unsigned>(value | static_cast<Unsigned>(byte << (8 * i)));
    }
    return value;
  }
  double number() { return std::bit_cast<double>(take<std::uint64_t>()); }
  std::string text() { return std::string(raw(take<std::uint32_t>())); }
  /// Reads the number of elements that follow, each of at least `least` bytes. Throws if they cannot fit.
  std::size_t count(std::size_t least) {
    const std::size_t many = take<std::uint32_t>();
    if (many > rest_.size() / least) throw DamagedBytes("promises more than it holds");
    return many;
  }
  bool empty() const { return rest_.empty(); }

 private:
  std::string_view raw(std::size_t count) {
    if (count > rest_.size()) throw DamagedBytes("ends too early");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace unicursal::host
