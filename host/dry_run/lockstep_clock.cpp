#include "host/dry_run/lockstep_clock.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "host/dry_run/simulator_process.hpp"

namespace unicursal::host {
namespace {

constexpr int byte_patience = 30000;  // ms for bytes to pass the terminal; microseconds as a rule

std::int64_t nanoseconds(TimePoint time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

LockstepClock::LockstepClock(const std::filesystem::path& control) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = control.string();
  if (path.size() < sizeof address.sun_path) {
    std::memcpy(address.sun_path, path.data(), path.size());
    socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket_ >= 0 && ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
      return;
    if (socket_ >= 0) ::close(socket_);
  }
  throw SimulatorError("the simulator's clock at " + path + " cannot be reached");
}

LockstepClock::~LockstepClock() {
  ::close(socket_);
}

void LockstepClock::set(asio::steady_timer& timer, TimePoint deadline) {
  timer.expires_at(TimePoint::max());
  alarms_.push_back({&timer, deadline});
}

void LockstepClock::forget(asio::steady_timer& timer) noexcept {
  std::erase_if(alarms_, [&](const Alarm& alarm) { return alarm.timer == &timer; });
}

void LockstepClock::attach(int port, std::function<std::uint64_t()> written) {
  if (written_) written_before_ += written_();
  port_ = port;
  written_ = std::move(written);
}

void LockstepClock::run(asio::io_context& loop) {
  while (!loop.stopped()) {
    if (loop.poll() > 0) continue;
    if (loop.stopped()) return;
    if (held())
      loop.run_one();
    else
      step();
  }
}

TimePoint LockstepClock::next_deadline() const {
  TimePoint next = TimePoint::max();
  for (const Alarm& alarm : alarms_) next = std::min(next, alarm.deadline);
  return next;
}

void LockstepClock::step() {
  const TimePoint until = next_deadline();
  if (until > now_) ask(until);
  ring();
}

void LockstepClock::ask(TimePoint until) {
  const std::string question =
      fmt::format("wait {} {}\n", until == TimePoint::max() ? -1 : nanoseconds(until),
                  written_before_ + (written_ ? written_() : 0));
  if (::send(socket_, question.data(), question.size(), MSG_NOSIGNAL) < 0) {
    throw SimulatorError("the simulator is gone");
  }
  const std::string said = answer();
  std::istringstream words(said);
  std::string at, state;
  std::int64_t time = 0;
  std::uint64_t bytes = 0;
  if (!(words >> at >> time >> bytes)) throw SimulatorError("the simulator's clock says \"" + said + "\"");
  words >> state;
  if (state == "idle" && until == TimePoint::max()) {
    throw SimulatorError("the host and the simulated printer wait for each other");
  }
  now_ = TimePoint(std::chrono::nanoseconds(time));
  await_bytes(bytes - handed_, state == "gone");
  handed_ = bytes;
}

std::string LockstepClock::answer() {
  for (;;) {
    const auto end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return line;
    }
    std::array<char, 128> bytes;
    const auto count = ::read(socket_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw SimulatorError("the simulator ended in the middle of the print");
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

/// Waits until the link can read everything that was handed over, so that it never sees a part of it.
void LockstepClock::await_bytes(std::uint64_t count, bool gone) const {
  if (port_ < 0 || (count == 0 && !gone)) return;
  for (;;) {
    pollfd wait{port_, POLLIN, 0};
    if (::poll(&wait, 1, byte_patience) == 0) throw SimulatorError("the simulator's words got lost");
    int readable = 0;
    if ((wait.revents & (POLLHUP | POLLERR)) != 0 || ::ioctl(port_, FIONREAD, &readable) != 0) return;
    if (!gone && static_cast<std::uint64_t>(readable) >= count) return;
  }
}

/// Expires every timer whose time has come.
void LockstepClock::ring() {
  for (const Alarm& alarm : alarms_) {
    if (alarm.deadline <= now_) alarm.timer->cancel();
  }
}

}  // namespace unicursal::host
