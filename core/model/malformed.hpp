// Text that does not follow its grammar, told without a place: whoever knows the file and the element adds
// them.
#pragma once

#include <stdexcept>

namespace unicursal::core {

class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace unicursal::core
