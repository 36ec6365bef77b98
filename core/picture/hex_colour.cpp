#include "core/picture/hex_colour.hpp"

#include <charconv>
#include <cstdint>

namespace unicursal::picture {

std::optional<Colour> colour_in(std::string_view text) {
  constexpr std::size_t length = 7;
  if (text.size() != length || text.front() != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return Colour{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 255),
                static_cast<std::uint8_t>(rgb & 255)};
}

std::string hex_of(Colour colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned value : {colour.r, colour.g, colour.b}) {
    text += digits[value / 16];
    text += digits[value % 16];
  }
  return text;
}

}  // namespace unicursal::picture
