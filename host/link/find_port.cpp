#include "host/link/find_port.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <fstream>
#include <optional>
#include <set>

#include "firmware_gcode/reply/reply.hpp"
#include "host/link/line_splitter.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;
using Time = std::chrono::steady_clock;

constexpr auto asking = 6s;        ///< An 8-bit board boots for two or three seconds.
constexpr auto ask_interval = 1s;  ///< A question during the boot is lost.

/// Makers of the chips on printers' boards: Arduino, its Italian branch, Teensy, WCH (CH340), FTDI, Silicon
/// Labs (CP210x), STMicroelectronics, OpenMoko (lent to Prusa, Duet, RAMPS clones), Prusa, Prolific,
/// Espressif, Raspberry Pi.
constexpr std::array<std::uint16_t, 12> makers{0x2341, 0x2a03, 0x16c0, 0x1a86, 0x0403, 0x10c4,
                                               0x0483, 0x1d50, 0x2c99, 0x067b, 0x303a, 0x2e8a};

bool is_likely(const PortInfo& port) {
  return port.usb_id && std::find(makers.begin(), makers.end(), port.usb_id->vendor) != makers.end();
}

std::optional<std::uint16_t> hexadecimal(std::string_view text) {
  std::uint16_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 4 || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<UsbId> usb_id_in(std::string_view text) {
  if (text.size() != 9 || text[4] != ':') return std::nullopt;
  const auto vendor = hexadecimal(text.substr(0, 4)), product = hexadecimal(text.substr(5));
  if (!vendor || !product) return std::nullopt;
  return UsbId{*vendor, *product};
}

/// A port that is being asked. The destructor closes it unless it was released.
class Asked {
 public:
  explicit Asked(int descriptor) : descriptor_(descriptor) {}
  Asked(Asked&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), splitter_(std::move(other.splitter_)) {}
  Asked& operator=(Asked&&) = delete;
  ~Asked() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  int descriptor() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

  void ask() {
    constexpr std::string_view question = "\nM115\n";
    [[maybe_unused]] const auto written = ::write(descriptor_, question.data(), question.size());
  }

  /// Reads the available bytes; returns whether a firmware has reported its name.
  bool answers() {
    std::array<char, 4096> bytes;
    const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
    if (count <= 0) return false;
    bool named = false;
    splitter_.feed({bytes.data(), static_cast<std::size_t>(count)}, [&](std::string_view line) {
      named = named || std::holds_alternative<gcode::reply::Firmware>(gcode::parse_reply(line));
    });
    return named;
  }

 private:
  int descriptor_;
  LineSplitter splitter_;
};

std::string names(const std::vector<PortInfo>& ports) {
  std::string text;
  for (const PortInfo& port : ports) text += (text.empty() ? "" : ", ") + port.path;
  return text;
}

/// Returns the index of the first port that answers by `until`.
std::optional<std::size_t> await_answer(std::vector<Asked>& asked, Time::time_point until) {
  std::vector<pollfd> ends;
  for (const Asked& port : asked) ends.push_back({port.descriptor(), POLLIN, 0});
  for (auto now = Time::now(); now < until; now = Time::now()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - now).count() + 1;
    if (::poll(ends.data(), ends.size(), static_cast<int>(left)) <= 0) continue;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if ((ends[i].revents & POLLIN) != 0 && asked[i].answers()) return i;
      if ((ends[i].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) ends[i].fd = -1;  // unplugged meanwhile
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<PortInfo> matching_ports(const std::vector<PortInfo>& ports, std::string_view wanted) {
  std::vector<PortInfo> matching;
  const auto keep = [&](auto&& fits) {
    std::copy_if(ports.begin(), ports.end(), std::back_inserter(matching), fits);
  };
  if (const auto id = usb_id_in(wanted)) {
    keep([&](const PortInfo& port) { return port.usb_id == id; });
  } else if (wanted == "auto") {
    keep([](const PortInfo& port) { return port.usb; });
    if (matching.empty()) matching = ports;
    std::stable_sort(matching.begin(), matching.end(),
                     [](const PortInfo& a, const PortInfo& b) { return is_likely(a) && !is_likely(b); });
  } else {
    matching.push_back({std::string(wanted), "", "", false, std::nullopt});
  }
  return matching;
}

bool must_answer(const std::vector<PortInfo>& meant, std::string_view wanted) {
  return meant.size() > 1 || (wanted == "auto" && !meant.front().usb);
}

std::string stable_name_of(const std::string& device, const std::filesystem::path& folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    std::error_code dangling;
    if (std::filesystem::canonical(entry.path(), dangling) == device && !dangling)
      return entry.path().string();
  }
  return {};
}

bool has_chip(const std::string& path, const std::filesystem::path& folder) {
  std::ifstream type(folder / std::filesystem::path(path).filename() / "type");
  int number = -1;
  return !(type >> number) || number != 0;
}

int open_answering_port(const std::vector<PortInfo>& ports, unsigned baud) {
  std::vector<Asked> asked;
  std::string why;
  for (const PortInfo& port : ports) {
    try {
      asked.emplace_back(open_port(port.path, baud));
    } catch (const PortError& error) {
      why = error.what();  // another port may be the printer
    }
  }
  if (asked.empty()) throw PortError(why);
  for (auto next = Time::now(), end = next + asking; next < end; next += ask_interval) {
    for (Asked& port : asked) port.ask();
    if (const auto found = await_answer(asked, next + ask_interval)) return asked[*found].release();
  }
  throw PortError(fmt::format(
      "none of the serial ports ({}) answers M115 at {} baud; switch the printer on, correct the rate in its "
      "profile, or say which port with --port",
      names(ports), baud));
}

}  // namespace unicursal::host
