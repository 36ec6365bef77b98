#include "tests/fuzz/replies.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <cmath>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/text/file_bytes.hpp"
#include "core/text/printable.hpp"
#include "firmware_gcode/reply/identity.hpp"
#include "firmware_gcode/reply/reply.hpp"
#include "host/doctor/examine.hpp"
#include "host/link/line_splitter.hpp"
#include "host/link/link.hpp"
#include "tests/fuzz/damage.hpp"
#include "tests/paths.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::array corpus{"marlin", "advanced-ok", "repetier"};

std::string damaged_transcript(const fs::path& folder, core::Random& random) {
  const fs::path sound = unicursal::test::data_folder() / "replies" / corpus[random.below(corpus.size())];
  std::string bytes = core::file_bytes(sound);
  for (std::size_t n = random.below(8); n > 0; --n) bytes = damaged(bytes, random);
  std::ofstream(folder / "replies", std::ios::binary) << bytes;
  return bytes;
}

/// Cuts bytes anywhere, as a serial line does.
template <class Take>
void in_pieces(std::string_view bytes, core::Random& random, Take&& take) {
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(1 + random.below(100), bytes.size());
    take(bytes.substr(0, size));
    bytes.remove_prefix(size);
  }
}

void require(bool sound, const char* what) {
  if (!sound) throw std::runtime_error(what);
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

void check(const std::string& line) {
  require(line.size() <= host::LineSplitter::longest, "a line grew beyond its bound");
  require(is_printable(core::printable(line)), "text was shown that cannot be");
  const gcode::Reply reply = gcode::parse_reply(line);
  const auto* ok = std::get_if<gcode::reply::Ok>(&reply);
  const auto* report = std::get_if<gcode::reply::TemperatureReport>(&reply);
  const gcode::Temperatures heat = ok       ? ok->temperatures
                                   : report ? report->temperatures
                                            : gcode::Temperatures{};
  for (const auto& degrees : {heat.nozzle, heat.nozzle_target, heat.bed, heat.bed_target})
    require(!degrees || std::isfinite(*degrees), "a temperature is not a number");
  if (const auto* told = std::get_if<gcode::reply::Firmware>(&reply)) {
    const gcode::Identity identity = gcode::identify(told->text);
    require(is_printable(identity.firmware) && is_printable(identity.machine), "a name cannot be shown");
  }
}

/// The other end: answers everything that it hears with a piece of its text, and then falls silent.
void say(int descriptor, const std::vector<std::string>& pieces) {
  std::array<char, 4096> heard;
  for (const std::string& piece : pieces) {
    pollfd wait{descriptor, POLLIN, 0};
    if (::poll(&wait, 1, 1) > 0 && ::read(descriptor, heard.data(), heard.size()) <= 0) break;
    if (::send(descriptor, piece.data(), piece.size(), MSG_NOSIGNAL) < 0) break;
  }
  ::close(descriptor);
}

host::LinkOptions impatient() {
  host::LinkOptions options;
  options.boot = options.quiet = options.keepalive = 1ms;
  options.silence = 3ms;
  options.no_ok = options.slow_ok = 20ms;
  options.temperatures = 1s;
  options.last_number = 20;
  return options;
}

}  // namespace

void read_replies(const fs::path& folder, core::Random& random) {
  const std::string bytes = damaged_transcript(folder, random);
  host::LineSplitter splitter;
  gcode::Identity identity;
  std::vector<std::string> lines;
  in_pieces(bytes, random, [&](std::string_view piece) {
    splitter.feed(piece, [&](std::string_view line) {
      lines.emplace_back(line);
      check(lines.back());
      const gcode::Reply reply = gcode::parse_reply(line);
      if (const auto* can = std::get_if<gcode::reply::Capability>(&reply)) identity.learn(can->name, can->on);
    });
  });
  require(identity.capabilities.size() <= gcode::Identity::most_capabilities, "too many capabilities");
  host::settings_in(lines);
}

void converse(const fs::path& folder, core::Random& random) {
  std::vector<std::string> pieces;
  in_pieces(damaged_transcript(folder, random), random,
            [&](std::string_view piece) { pieces.emplace_back(piece); });
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::runtime_error("no socket");
  const std::jthread printer([&] { say(ends[1], pieces); });
  asio::io_context loop{1};
  host::Link link(loop.get_executor(), ends[0], impatient());
  std::exception_ptr failure;
  const std::vector<std::string> lines(50, "G1 X10.125 Y20.5 E.0123");
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        try {
          co_await link.connect();
          co_await link.send(lines);
          co_await link.drain();
        } catch (const host::LinkError&) {
          // This printer's replies make no sense, so a LinkError is a proper end.
        }
      },
      [&](std::exception_ptr thrown) {
        failure = thrown;
        loop.stop();
      });
  loop.run();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace unicursal::test
