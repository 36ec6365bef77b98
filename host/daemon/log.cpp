#include "host/daemon/log.hpp"

#include <poll.h>
#include <unistd.h>

#include <climits>

#include "core/text/printable.hpp"

namespace unicursal::host {

void log_line(const std::string& text) {
  // A pipe that is ready takes PIPE_BUF bytes without waiting (poll(2), pipe(7)).
  constexpr std::size_t longest = 800;  // fourfold at worst, when made printable
  static_assert(4 * longest + 4 < PIPE_BUF);
  const std::string line = core::printable(text, longest) + "\n";
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0) return;
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace unicursal::host
