#include "sim/lockstep.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {

constexpr double ns = 1e-9;
constexpr std::size_t longest_message = 128;
/// Time that bytes from the host may take to reach this end of the terminal, ms. They normally take
/// microseconds; the limit is for a very busy computer.
constexpr int byte_patience = 30000;
/// Number of printer events (a fraction of a second's work) between two checks that the host still waits.
constexpr std::uint64_t steps_between_looks = 100'000;

[[noreturn]] void refuse(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

Lockstep::Lockstep(const SimulatorOptions& options, Printer& printer,
                   std::function<void(const std::string&)> ready)
    : options_(options),
      printer_(printer),
      ready_(std::move(ready)),
      terminal_(std::make_unique<Terminal>(options.link)) {
  listen();
  ready_(terminal_->path());
}

Lockstep::~Lockstep() {
  std::error_code ignored;
  std::filesystem::remove(*options_.control, ignored);
}

void Lockstep::listen() {
  const std::string path = options_.control->string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    refuse("cannot make the control socket " + path);
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  if (std::filesystem::is_socket(std::filesystem::symlink_status(path))) std::filesystem::remove(path);
  listener_ = Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (listener_.get() < 0 ||
      ::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener_.get(), 1) != 0) {
    refuse("cannot make the control socket " + path);
  }
}

void Lockstep::run() {
  while (!stopped_ && accept_host()) {
    serve();
    if (printer_.unplugged())
      replug();
    else
      take_rest();
    if (options_.once && used_) break;
  }
}

/// Returns false if a signal arrives first.
bool Lockstep::readable(int descriptor) {
  pollfd waits[2] = {{stop_.descriptor(), POLLIN, 0}, {descriptor, POLLIN, 0}};
  while (::poll(waits, 2, -1) < 0 && errno == EINTR) {
  }
  if (waits[0].revents != 0) stopped_ = true;
  return !stopped_;
}

bool Lockstep::accept_host() {
  if (!readable(listener_.get())) return false;
  host_ = Descriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  pending_.clear();
  heard_ = told_ = 0;
  return host_.get() >= 0;
}

void Lockstep::serve() {
  bool opened = false;
  while (terminal_) {
    const auto wait = next_wait();
    if (!wait) return;
    if (!std::exchange(opened, true)) printer_.opened(dtr_low_);
    take_bytes(wait->bytes);
    if (!advance(wait->until)) return;
    answer();
  }
}

std::optional<HostWait> Lockstep::next_wait() {
  const auto message = read_message();
  if (!message) return std::nullopt;
  const auto wait = parse_wait(*message);
  if (!wait || wait->bytes < heard_) {
    throw std::runtime_error("the host sent \"" + *message + "\" on the control socket, which is not valid");
  }
  return wait;
}

/// Returns false if the host hangs up meanwhile or a signal arrives: a lot can happen before there is
/// something to read.
bool Lockstep::advance(double until) {
  while (!printer_.advance(until, steps_between_looks)) {
    pollfd looks[2] = {{stop_.descriptor(), POLLIN, 0}, {host_.get(), POLLIN, 0}};
    if (::poll(looks, 2, 0) <= 0) continue;
    stopped_ = stopped_ || looks[0].revents != 0;
    if (stopped_ || (looks[1].revents & POLLHUP) != 0) return false;
  }
  return true;
}

/// Returns nullopt if the host has closed the socket or a signal arrives.
std::optional<std::string> Lockstep::read_message() {
  for (;;) {
    const auto end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string message = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return message;
    }
    if (pending_.size() > longest_message)
      throw std::runtime_error("the host sent too long a message on the control socket");
    if (host_.get() < 0 || !readable(host_.get())) return std::nullopt;
    std::array<char, longest_message> bytes;
    const auto count = ::read(host_.get(), bytes.data(), bytes.size());
    if (count <= 0) return std::nullopt;
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

/// Takes all the bytes that the host says it has written; waits until the terminal has passed them on.
void Lockstep::take_bytes(std::uint64_t total) {
  while (heard_ < total) {
    pollfd wait{terminal_->master(), POLLIN, 0};
    if (::poll(&wait, 1, byte_patience) <= 0) {
      throw std::runtime_error(
          fmt::format("the host says that it has written {} bytes, but only {} arrived", total, heard_));
    }
    const auto bytes = terminal_->read();
    if (!bytes) return;
    heard_ += bytes->size();
    used_ = true;
    printer_.write(*bytes);
  }
}

/// Called after the host has hung up: its last bytes may still be in the terminal.
void Lockstep::take_rest() {
  dtr_low_ = terminal_->drops_dtr();
  for (auto bytes = terminal_->read(); bytes && !bytes->empty(); bytes = terminal_->read()) {
    printer_.write(*bytes);
    used_ = true;
  }
  terminal_->clear();
}

void Lockstep::answer() {
  const bool idle = !printer_.has_output() && !printer_.next_event() && !printer_.unplugged();
  const std::string bytes = printer_.take_output();
  told_ += bytes.size();
  hand_over(bytes);
  const char* state = printer_.unplugged() ? " gone" : idle ? " idle" : "";
  if (printer_.unplugged()) terminal_.reset();
  const std::string message =
      fmt::format("at {} {}{}\n", static_cast<std::int64_t>(std::llround(printer_.now() / ns)), told_, state);
  if (::send(host_.get(), message.data(), message.size(), MSG_NOSIGNAL) < 0) host_ = Descriptor();
}

void Lockstep::hand_over(std::string bytes) {
  for (terminal_->write(bytes); !bytes.empty(); terminal_->write(bytes)) {
    pollfd wait{terminal_->master(), POLLOUT, 0};
    if (::poll(&wait, 1, byte_patience) <= 0) return;  // the host does not read
  }
}

/// Waits for the cable. A host can only return after it.
void Lockstep::replug() {
  stopped_ = stopped_ || !std::isfinite(printer_.plug_time());
  if (stopped_) return;
  printer_.advance(printer_.plug_time());
  printer_.plug_in();
  dtr_low_ = true;
  terminal_ = std::make_unique<Terminal>(options_.link);
  ready_(terminal_->path());
}

}  // namespace unicursal::sim
