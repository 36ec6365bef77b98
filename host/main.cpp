#include <fcntl.h>
#include <unistd.h>

#include "host/cli/cli.hpp"

namespace {

/// Opens /dev/null as each standard stream that is closed. Otherwise the next files that the program opens,
/// such as the serial port, would take their numbers and receive the messages for people.
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
