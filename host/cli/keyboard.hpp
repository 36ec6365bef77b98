// Single keys from the terminal, so that what a person types can stand on a line of its own below the
// progress of a print. The keys of signals (Ctrl-C) and of flow control (Ctrl-S) still work.
#pragma once

#include <termios.h>

#include <optional>

namespace unicursal::host {

class Keyboard {
 public:
  /// Takes the terminal behind standard input, if this program is in its foreground.
  Keyboard();
  /// Gives it back as it was.
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Whether it gives single keys and does not show them itself.
  bool held() const { return before_.has_value(); }

 private:
  std::optional<termios> before_;
};

}  // namespace unicursal::host
