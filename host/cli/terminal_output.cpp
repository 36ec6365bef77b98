#include "host/cli/terminal_output.hpp"

#include <unistd.h>

#include "host/cli/for_terminal.hpp"
#include "host/cli/terminal_look.hpp"
#include "host/cli/wrapped.hpp"

namespace unicursal::host {

void show_text(std::FILE* stream, const std::string& text) {
  const int descriptor = ::fileno(stream);
  std::string safe = for_terminal(text);
  if (::isatty(descriptor) == 1) safe = wrapped(safe, terminal_width(descriptor));
  std::fputs(safe.c_str(), stream);
}

}  // namespace unicursal::host
