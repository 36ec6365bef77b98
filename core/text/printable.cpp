#include "core/text/printable.hpp"

#include <fmt/format.h>

namespace unicursal::core {

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  for (char c : text.substr(0, limit)) {
    if (c >= ' ' && c <= '~')
      result += c;
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  if (text.size() > limit) result += "...";
  return result;
}

}  // namespace unicursal::core
