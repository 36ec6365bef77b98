// Lists and opens serial ports. libserialport 0.1.1 looks devices up in sysfs and refuses those that it does
// not find there, such as pseudo-terminals; these are opened and set raw directly.
#include <fcntl.h>
#include <fmt/format.h>
#include <libserialport.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <system_error>

#include "core/text/printable.hpp"
#include "host/files/descriptor.hpp"
#include "host/link/find_port.hpp"
#include "host/link/line_rate.hpp"
#include "host/link/port_holder.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

struct FreePort {
  void operator()(sp_port* port) const { sp_free_port(port); }
};
using Port = std::unique_ptr<sp_port, FreePort>;

struct FreeConfig {
  void operator()(sp_port_config* config) const { sp_free_config(config); }
};

[[noreturn]] void refuse(const std::string& path, int error) {
  std::string why;
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      why = brltty_runs()
                ? "this port does not exist; brltty, the driver of braille displays, takes the USB chips of "
                  "printers: if you do not use such a display, remove it with `sudo apt remove brltty` and "
                  "plug the printer in again"
                : "this port does not exist; plug the printer in and see `unicursal ports`";
      break;
    case EACCES:
    case EPERM:
      why = "you may not open it; add yourself to the group dialout and log in again";
      break;
    case EBUSY:
      why = holder_of(path).value_or("another program") + " is using it; close that program first";
      break;
    case ENOTTY:
    case EISDIR:
      why = "it is not a serial port; see `unicursal ports` for those that are";
      break;
    default:
      why = std::string(std::strerror(error)) + "; check the cable and the printer's power";
  }
  throw PortError(core::printable(path) + ": " + why);
}

/// The names in /dev/serial/by-id, by device.
std::map<fs::path, std::string> stable_names() {
  std::map<fs::path, std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", none)) {
    std::error_code dangling;
    const fs::path device = fs::canonical(entry.path(), dangling);
    if (!dangling) names[device] = entry.path().string();
  }
  return names;
}

std::string text(const char* from) {
  return from == nullptr ? std::string() : core::printable(from);
}

/// Opens the port without changing its settings. An error is ignored; opening it again will report it.
Descriptor open_as_left(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
}

/// HUPCL is still off if this program had the port before and the cable was not pulled since.
bool keeps_dtr(int fd) {
  termios settings{};
  return fd >= 0 && ::tcgetattr(fd, &settings) == 0 && (settings.c_cflag & HUPCL) == 0;
}

/// Clears HUPCL: otherwise closing the port drops DTR, and the next opening resets many boards.
void keep_dtr(int fd) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  ::tcsetattr(fd, TCSANOW, &settings);
}

/// Asks for low latency: by default FTDI's chips hold short replies back for 16 ms, so a window of 127 bytes
/// uses only a quarter of a 250 000 baud line. Other drivers ignore it.
void hasten(int fd) {
  serial_struct settings{};
  if (::ioctl(fd, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(fd, TIOCSSERIAL, &settings);
}

/// Locks the port. TIOCEXCL does not keep root out; this lock keeps out a second print by any user.
void claim(int fd, const std::string& path) {
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse(path, EBUSY);
}

int open_real(sp_port* port, const std::string& path, unsigned baud) {
  if (sp_open(port, SP_MODE_READ_WRITE) != SP_OK) refuse(path, sp_last_error_code());
  const std::unique_ptr<sp_port, decltype(&sp_close)> closing(port, &sp_close);
  int handle = -1;
  if (sp_get_port_handle(port, &handle) != SP_OK) refuse(path, ENODEV);
  claim(handle, path);
  sp_port_config* made = nullptr;
  if (sp_new_config(&made) != SP_OK) refuse(path, ENOMEM);
  const std::unique_ptr<sp_port_config, FreeConfig> config(made);
  sp_set_config_baudrate(config.get(), static_cast<int>(baud));
  sp_set_config_bits(config.get(), 8);
  sp_set_config_parity(config.get(), SP_PARITY_NONE);
  sp_set_config_stopbits(config.get(), 1);
  sp_set_config_flowcontrol(config.get(), SP_FLOWCONTROL_NONE);
  if (sp_set_config(port, config.get()) != SP_OK) {
    throw PortError(
        fmt::format("{}: the port cannot run at {} baud; correct the rate in the printer's profile",
                    core::printable(path), baud));
  }
  keep_dtr(handle);
  hasten(handle);
  const int own = ::fcntl(handle, F_DUPFD_CLOEXEC, 0);  // stays open when the library closes its own
  if (own < 0) refuse(path, errno);
  return own;
}

/// Opens a port that libserialport does not know, such as a pseudo-terminal, which only stores its baud rate.
int open_direct(const std::string& path, unsigned baud) {
  Descriptor port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (port.get() < 0) refuse(path, errno);
  termios settings{};
  if (::tcgetattr(port.get(), &settings) != 0) refuse(path, errno);
  claim(port.get(), path);
  if (::ioctl(port.get(), TIOCEXCL) != 0) refuse(path, errno);
  ::cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  settings.c_cflag |= CLOCAL | CREAD;
  if (::tcsetattr(port.get(), TCSANOW, &settings) != 0) refuse(path, errno);
  set_line_rate(port.get(), baud);
  return port.release();
}

std::optional<UsbId> usb_id_of(const sp_port* port) {
  int vendor = 0, product = 0;
  if (sp_get_port_usb_vid_pid(port, &vendor, &product) != SP_OK) return std::nullopt;
  return UsbId{static_cast<std::uint16_t>(vendor), static_cast<std::uint16_t>(product)};
}

/// What hangs on the port: the names that a device on USB gives itself, or the kind of port.
std::string device_words(const sp_port* port) {
  const std::string maker = text(sp_get_port_usb_manufacturer(port)),
                    product = text(sp_get_port_usb_product(port));
  if (maker.empty() && product.empty()) return text(sp_get_port_description(port));
  return maker.empty() || product.starts_with(maker) ? product : product + ", by " + maker;
}

}  // namespace

std::vector<PortInfo> list_ports() {
  sp_port** found = nullptr;
  if (sp_list_ports(&found) != SP_OK) return {};
  const std::unique_ptr<sp_port*, decltype(&sp_free_port_list)> freeing(found, &sp_free_port_list);
  const auto names = stable_names();
  std::vector<PortInfo> ports;
  for (sp_port** port = found; *port != nullptr; ++port) {
    PortInfo info{text(sp_get_port_name(*port)), "", device_words(*port),
                  sp_get_port_transport(*port) == SP_TRANSPORT_USB, usb_id_of(*port)};
    if (!info.usb && !has_chip(info.path)) continue;
    if (const auto name = names.find(info.path); name != names.end()) info.stable_path = name->second;
    ports.push_back(info);
  }
  std::stable_sort(ports.begin(), ports.end(),
                   [](const PortInfo& a, const PortInfo& b) { return a.usb && !b.usb; });
  return ports;
}

int open_port(const std::string& path, unsigned baud) {
  LinkOptions ignored;
  return open_port(path, baud, ignored);
}

int open_port(const std::string& path, unsigned baud, LinkOptions& options) {
  const std::vector<PortInfo> meant = matching_ports(list_ports(), path);
  if (meant.empty()) throw PortError("no such serial port was found; plug the printer in and switch it on");
  if (must_answer(meant, path)) {
    options.boot = {};
    return open_answering_port(meant, baud);
  }
  const std::string& wanted = meant.front().path;
  std::error_code missing;
  const fs::path device = fs::canonical(wanted, missing);  // libserialport does not follow links
  if (missing) refuse(wanted, missing.value());
  const Descriptor before = open_as_left(device.string());
  if (keeps_dtr(before.get())) options.boot = {};
  sp_port* found = nullptr;
  if (sp_get_port_by_name(device.c_str(), &found) != SP_OK) return open_direct(device.string(), baud);
  const Port port(found);
  return open_real(port.get(), wanted, baud);
}

std::string device_of(int port) {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/fd/" + std::to_string(port), unknown).string();
}

}  // namespace unicursal::host
