// Text that does not follow its grammar. The error names no place: the caller adds the file and the element.
#pragma once

#include <stdexcept>

namespace unicursal::core {

class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace unicursal::core
