// A printer whose cable was pulled while its nozzle was hot.
#pragma once

#include <string>

#include "host/link/link.hpp"

namespace unicursal::host {

struct Cooling {
  enum class Ending { cooled, time_over, gave_up };

  Ending ending = Ending::time_over;
  std::string reason;  ///< of giving up
};

/// Opens the port as soon as it is there again, and switches its heaters off; blocks. The time is over after
/// five minutes. It gives up at one of the signals that stop a print at once, and at an error that is not the
/// link's.
Cooling cool_when_back(const std::string& port, unsigned baud, LinkOptions options);

}  // namespace unicursal::host
