#include "firmware_gcode/dialect/number.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace unicursal::gcode {
namespace {

constexpr std::array<std::int64_t, 10> powers_of_ten = {1,      10,      100,      1000,      10000,
                                                        100000, 1000000, 10000000, 100000000, 1000000000};

void append_integer(std::string& text, std::int64_t value) {
  std::array<char, 24> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

}  // namespace

std::int64_t scaled(double value, int decimals) {
  assert(std::isfinite(value) && std::abs(value) < 1e12 && decimals >= 0 && decimals <= 6);
  return std::llround(value * static_cast<double>(powers_of_ten[static_cast<std::size_t>(decimals)]));
}

void append_scaled(std::string& text, std::int64_t value, int decimals) {
  assert(decimals >= 0 && decimals <= 9);
  if (value < 0) text += '-', value = -value;
  const std::int64_t unit = powers_of_ten[static_cast<std::size_t>(decimals)];
  const std::int64_t whole = value / unit;
  std::int64_t fraction = value % unit;
  if (whole != 0 || fraction == 0) append_integer(text, whole);
  if (fraction == 0) return;
  text += '.';
  for (std::int64_t digit = unit / 10; fraction > 0; fraction %= digit, digit /= 10) {
    text += static_cast<char>('0' + fraction / digit);
    if (digit == 1) break;
  }
}

std::string short_number(double value, int decimals) {
  std::string text;
  append_scaled(text, scaled(value, decimals), decimals);
  return text;
}

}  // namespace unicursal::gcode
