#include "host/engine/reset_line.hpp"

#include <sys/ioctl.h>
#include <termios.h>

#include <chrono>
#include <thread>

namespace unicursal::host {
namespace {

constexpr auto pulse =
    std::chrono::milliseconds(100);  ///< the capacitor on the board needs a few milliseconds

}  // namespace

bool pulse_reset(int port) {
  const int wire = TIOCM_DTR;
  if (::ioctl(port, TIOCMBIC, &wire) != 0) return false;
  std::this_thread::sleep_for(pulse);
  return ::ioctl(port, TIOCMBIS, &wire) == 0;
}

}  // namespace unicursal::host
