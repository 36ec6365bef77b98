#include "host/report/peak_memory.hpp"

#include <fstream>
#include <sstream>
#include <string>

namespace unicursal::host {

double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    double kib = 0;
    std::istringstream(line.substr(6)) >> kib;
    return kib / 1024;
  }
  return 0;
}

}  // namespace unicursal::host
