// Random damage to files: bytes are changed, lost or doubled, numbers become extreme.
#pragma once

#include <array>
#include <cctype>
#include <string>

#include "core/numeric/random.hpp"

namespace unicursal::test {

inline std::string with_extreme_number(const std::string& bytes, core::Random& random) {
  static constexpr std::array numbers{
      "0", "-0", "1e300", "-1e300", "1e-320", "nan", "inf", "1e99999", "1e5", "-1", "99999999999999999999",
      ".", "1e"};
  const std::size_t from = bytes.find_first_of("0123456789", random.below(bytes.size()));
  if (from == std::string::npos) return bytes;
  const std::size_t to = bytes.find_first_not_of("0123456789.eE+-", from);
  return bytes.substr(0, from) + numbers[random.below(numbers.size())] +
         (to == std::string::npos ? "" : bytes.substr(to));
}

inline std::string damaged(std::string bytes, core::Random& random) {
  static const std::string seasoning = "0123456789-.eE%<>/'\"=#;:()[]{},MmLlCcAaZz \n\t\xff";
  for (std::size_t n = 1 + random.below(6); n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random.below(bytes.size());
    switch (random.below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes[at] = seasoning[random.below(seasoning.size())];
        break;
      case 2:
        bytes.erase(at, 1 + random.below(20));
        break;
      case 3:
        bytes.insert(at, bytes.substr(random.below(bytes.size()), 1 + random.below(60)));
        break;
      case 4:
        bytes = with_extreme_number(bytes, random);
        break;
      default:
        if (random.below(20) == 0) bytes.resize(at);
    }
  }
  return bytes;
}

}  // namespace unicursal::test
