// A printer whose cable was pulled while its nozzle was hot.
#pragma once

#include <string>

#include "host/link/link.hpp"

namespace unicursal::host {

/// Opens the port as soon as it is there again, and switches the nozzle off; blocks. Returns false if the
/// printer does not come back within five minutes, or one of the signals that end a print ends the waiting.
bool cool_when_back(const std::string& port, unsigned baud, LinkOptions options);

}  // namespace unicursal::host
