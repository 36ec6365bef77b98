#include "host/daemon/plain_name.hpp"

#include <algorithm>

namespace unicursal::host {

bool is_plain_name(const std::string& name) {
  constexpr std::size_t longest_name = 64;
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= longest_name && name.front() != '.' && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), plain);
}

}  // namespace unicursal::host
