#include "host/cli/keyboard.hpp"

#include <unistd.h>

namespace unicursal::host {

Keyboard::Keyboard() {
  termios mode{};
  // A program in the background would be halted if it changed the terminal. TCSANOW does not wait for one
  // that is halted with Ctrl-S.
  if (tcgetpgrp(STDIN_FILENO) != getpgrp() || tcgetattr(STDIN_FILENO, &mode) != 0) return;
  const termios before = mode;
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  if (tcsetattr(STDIN_FILENO, TCSANOW, &mode) == 0) before_ = before;
}

Keyboard::~Keyboard() {
  if (before_ && tcgetpgrp(STDIN_FILENO) == getpgrp()) tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

}  // namespace unicursal::host
