// Checks of the methods that were written for the comparison, on small shapes: a bad opponent is easily
// beaten.
#pragma once

#include <string>
#include <vector>

namespace unicursal::bench {

/// Describes each fault; empty if all is well.
std::vector<std::string> faults_of_methods();

}  // namespace unicursal::bench
