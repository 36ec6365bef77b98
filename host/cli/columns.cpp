#include "host/cli/columns.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/text/utf8.hpp"

namespace unicursal::host {
namespace {

struct Block {
  char32_t first, last;
};

constexpr std::array<Block, 9> wide{{{0x1100, 0x115f},
                                     {0x2e80, 0xa4cf},
                                     {0xac00, 0xd7a3},
                                     {0xf900, 0xfaff},
                                     {0xfe30, 0xfe6f},
                                     {0xff00, 0xff60},
                                     {0xffe0, 0xffe6},
                                     {0x1f300, 0x1faff},
                                     {0x20000, 0x3fffd}}};
constexpr std::array<Block, 3> without_width{{{0x300, 0x36f}, {0x200b, 0x200f}, {0xfe00, 0xfe0f}}};

template <std::size_t Count>
bool lies_in(const std::array<Block, Count>& blocks, char32_t character) {
  return std::any_of(blocks.begin(), blocks.end(), [character](const Block& block) {
    return character >= block.first && character <= block.last;
  });
}

/// Precondition: `bytes` is one character.
char32_t code_point(std::string_view bytes) {
  constexpr std::array<unsigned, 5> first_bits{0, 0x7f, 0x1f, 0x0f, 0x07};
  char32_t value = static_cast<unsigned char>(bytes[0]) & first_bits.at(bytes.size());
  for (const char byte : bytes.substr(1)) value = value << 6U | (static_cast<unsigned char>(byte) & 0x3fU);
  return value;
}

std::size_t width_of(std::string_view character) {
  const char32_t code = code_point(character);
  if (lies_in(without_width, code)) return 0;
  return lies_in(wide, code) ? 2 : 1;
}

/// A byte that does not belong to a character counts as one.
std::vector<std::string_view> characters(std::string_view text) {
  std::vector<std::string_view> found;
  while (!text.empty()) {
    found.push_back(text.substr(0, std::max<std::size_t>(core::utf8_size(text), 1)));
    text.remove_prefix(found.back().size());
  }
  return found;
}

}  // namespace

std::size_t columns(std::string_view text) {
  std::size_t sum = 0;
  for (const std::string_view character : characters(text)) sum += width_of(character);
  return sum;
}

std::string beginning(std::string_view text, std::size_t width) {
  std::string kept;
  for (const std::string_view character : characters(text)) {
    const std::size_t next = width_of(character);
    if (next > width) break;
    width -= next;
    kept += character;
  }
  return kept;
}

std::string ending(std::string_view text, std::size_t width) {
  const std::vector<std::string_view> all = characters(text);
  std::size_t bytes = 0;
  for (auto character = all.rbegin(); character != all.rend(); ++character) {
    const std::size_t next = width_of(*character);
    if (next > width) break;
    width -= next;
    bytes += character->size();
  }
  return std::string(text.substr(text.size() - bytes));
}

}  // namespace unicursal::host
