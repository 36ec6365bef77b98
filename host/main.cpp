#include <fcntl.h>
#include <unistd.h>

#include "host/cli/cli.hpp"

namespace {

/// Whoever starts this program with its standard streams closed would otherwise find words for people in the
/// next files that it opens: the printer's line, or what is kept of the print.
void occupy_standard_streams() {
  int descriptor = 0;
  do {
    descriptor = open("/dev/null", O_RDWR | O_CLOEXEC);
  } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO) close(descriptor);
}

}  // namespace

int main(int argc, char** argv) {
  occupy_standard_streams();
  return unicursal::host::run_command_line(argc, argv);
}
