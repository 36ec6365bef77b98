#include "host/link/line_rate.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>

extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept;

namespace unicursal::host {

void set_line_rate(int descriptor, unsigned baud) {
  termios2 settings{};
  if (ioctl(descriptor, TCGETS2, &settings) != 0) return;
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
  settings.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = settings.c_ospeed = baud;
  ioctl(descriptor, TCSETS2, &settings);
}

unsigned line_rate(int descriptor) {
  termios2 settings{};
  return ioctl(descriptor, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

}  // namespace unicursal::host
