#include "sim/line/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/inotify.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace unicursal::sim {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

Descriptor open_slave(const std::string& path) {
  Descriptor slave(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (slave.get() < 0) fail("cannot open the pseudo-terminal " + path);
  return slave;
}

/// Whether a new link may replace this file.
bool replaceable(const std::filesystem::path& link) {
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(link))) return false;
  return !std::filesystem::exists(link) || std::filesystem::is_character_file(link);
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Terminal::Terminal(std::optional<std::filesystem::path> link)
    : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)),
      openings_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      link_(std::move(link)) {
  if (master_.get() < 0 || ::grantpt(master()) != 0 || ::unlockpt(master()) != 0) {
    fail("cannot make a pseudo-terminal");
  }
  std::array<char, 64> name{};
  if (::ptsname_r(master(), name.data(), name.size()) != 0) fail("cannot name the pseudo-terminal");
  path_ = name.data();
  {
    const Descriptor slave = open_slave(path_);
    termios settings{};
    ::tcgetattr(slave.get(), &settings);
    ::cfmakeraw(&settings);
    settings.c_cflag |= HUPCL;  // the default of a real port
    if (::tcsetattr(slave.get(), TCSANOW, &settings) != 0) fail("cannot make " + path_ + " raw");
  }
  if (openings() < 0 || ::inotify_add_watch(openings(), path_.c_str(), IN_OPEN) < 0)
    fail("cannot watch " + path_);
  if (link_) make_link();
}

Terminal::~Terminal() {
  std::error_code ignored;
  if (link_ && std::filesystem::read_symlink(*link_, ignored) == path_)
    std::filesystem::remove(*link_, ignored);
}

void Terminal::make_link() {
  const std::filesystem::path link = *std::exchange(link_, std::nullopt);  // not ours until it is made
  if (std::filesystem::exists(std::filesystem::symlink_status(link))) {
    if (!replaceable(link)) {
      throw std::system_error(EEXIST, std::generic_category(),
                              link.string() + " is in the way; choose another name for the link");
    }
    std::filesystem::remove(link);
  }
  std::error_code problem;
  std::filesystem::create_symlink(path_, link, problem);
  if (problem) throw std::filesystem::filesystem_error("no link", link, problem);
  link_ = link;
}

void Terminal::forget_openings() {
  std::array<char, 4096> events;
  while (::read(openings(), events.data(), events.size()) > 0) {
  }
}

bool Terminal::host_present() const {
  pollfd state{master(), POLLIN, 0};
  ::poll(&state, 1, 0);
  return (state.revents & POLLHUP) == 0 || (state.revents & POLLIN) != 0;
}

std::optional<std::string> Terminal::read() {
  std::array<char, 4096> bytes;
  const auto count = ::read(master(), bytes.data(), bytes.size());
  if (count > 0) return std::string(bytes.data(), static_cast<std::size_t>(count));
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::string();
  return std::nullopt;
}

void Terminal::write(std::string& bytes) {
  while (!bytes.empty()) {
    const auto count = ::write(master(), bytes.data(), bytes.size());
    if (count <= 0) return;
    bytes.erase(0, static_cast<std::size_t>(count));
  }
}

bool Terminal::drops_dtr() const {
  termios settings{};
  return ::tcgetattr(master(), &settings) != 0 || (settings.c_cflag & HUPCL) != 0;
}

void Terminal::clear() {
  ::tcflush(open_slave(path_).get(), TCIOFLUSH);
}

}  // namespace unicursal::sim
