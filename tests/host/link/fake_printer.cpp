#include "fake_printer.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace unicursal::test {
namespace {

constexpr int tick_ms = 200;

int checksum(std::string_view text) {
  int sum = 0;
  for (char c : text) sum ^= static_cast<unsigned char>(c);
  return sum;
}

}  // namespace

FakePrinter::FakePrinter(FakeBehaviour behaviour) : behaviour_(std::move(behaviour)) {
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) throw std::runtime_error("no pty");
  path_ = ::ptsname(master_);
  slave_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  ::tcgetattr(slave_, &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(slave_, TCSANOW, &settings);
  if (::pipe(stop_) != 0) throw std::runtime_error("no pipe");
  if (behaviour_.boots) {
    for (const char* line : {"start", "PowerUp", "Marlin 2.1.2.1", "echo: Last Updated: today"}) reply(line);
    flush();
  }
  thread_ = std::thread([this] { run(); });
}

FakePrinter::~FakePrinter() {
  stop();
  for (int fd : {master_, slave_, stop_[0], stop_[1]}) {
    if (fd >= 0) ::close(fd);
  }
}

void FakePrinter::stop() {
  if (!thread_.joinable()) return;
  [[maybe_unused]] const auto written = ::write(stop_[1], "x", 1);
  thread_.join();
}

void FakePrinter::hang_up() {
  silent_ = true;
  ::close(std::exchange(slave_, -1));
  ::close(std::exchange(master_, -1));
}

void FakePrinter::run() {
  std::array<char, 4096> buffer;
  while (master_ >= 0) {
    pollfd ends[2] = {{master_, POLLIN, 0}, {stop_[0], POLLIN, 0}};
    const int ready = ::poll(ends, 2, behaviour_.on_tick ? tick_ms : -1);
    if (ready == 0) {
      behaviour_.on_tick(*this);
      flush();
      continue;
    }
    if ((ends[0].revents & POLLIN) == 0) return;  // it was asked to stop, and everything has been read
    const auto count = ::read(master_, buffer.data(), buffer.size());
    if (count <= 0) return;
    receive({buffer.data(), static_cast<std::size_t>(count)});
    flush();
  }
}

void FakePrinter::receive(std::string_view bytes) {
  longest_burst_ = std::max(longest_burst_, bytes.size());
  // Damage precedes the splitting into lines, so that it can hit a newline, too.
  while (!bytes.empty()) {
    const auto end = std::min(bytes.find('\n'), bytes.size() - 1) + 1;
    std::string piece(bytes.substr(0, end));
    bytes.remove_prefix(end);
    input_ += behaviour_.inwards ? behaviour_.inwards(piece) : piece;
  }
  for (auto end = input_.find('\n'); end != std::string::npos; end = input_.find('\n')) {
    const std::string line = input_.substr(0, end);
    input_.erase(0, end + 1);
    if (!process(line)) input_.clear();  // a firmware flushes its buffer after an error
    if (master_ < 0) return;
  }
}

bool FakePrinter::process(const std::string& line) {
  if (line.empty() || silent_) return true;
  if (line.front() == 'N') return process_numbered(line);
  execute(line.substr(0, line.find('*')), false);
  return true;
}

bool FakePrinter::process_numbered(const std::string& line) {
  const auto star = line.rfind('*');
  if (star == std::string::npos) return refuse("No Checksum with line number"), false;
  if (std::atoi(line.c_str() + star + 1) != checksum(std::string_view(line).substr(0, star))) {
    return refuse("checksum mismatch"), false;
  }
  const long number = std::atol(line.c_str() + 1);
  const auto space = line.find(' ');
  const std::string command = space < star ? line.substr(space + 1, star - space - 1) : "";
  if (command.starts_with("M110")) {
    last_ = number;
    execute(command, true);
    return true;
  }
  if (last_ > 0 && (number == last_ || number == last_ - 1)) return ++dropped_repeats_, true;
  if (number != last_ + 1) return refuse("Line Number is not Last Line Number+1"), false;
  last_ = number;
  execute(command, true);
  return true;
}

void FakePrinter::refuse(const std::string& why) {
  ++errors_;
  reply("Error:" + why + ", Last Line: " + std::to_string(last_));
  reply("Resend: " + std::to_string(last_ + 1));
  reply("ok");
}

void FakePrinter::execute(const std::string& command, bool numbered) {
  if (command == "M112") {
    killed_ = true;
    reply("echo:M112 Shutdown");
    reply("Error:Printer halted. kill() called!");
    silent_ = true;
    return;
  }
  if (command == "M105") return reply("ok T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0");
  if (numbered && !command.starts_with("M110")) {
    ++accepted_;
    executed_.push_back(command);
    if (behaviour_.instead && behaviour_.instead(*this, accepted_, command)) return;
  }
  if (command == "M115")
    reply("FIRMWARE_NAME:Marlin 2.1.2.1 (fake) MACHINE_TYPE:Diamond EXTRUDER_COUNT:1");
  else if (command.empty() || std::string("GMT").find(command.front()) == std::string::npos) {
    reply("echo:Unknown command: \"" + command + "\"");
  }
  acknowledge(numbered);
}

void FakePrinter::acknowledge(bool numbered) {
  if (!behaviour_.advanced) return reply("ok");
  reply("ok" + (numbered ? " N" + std::to_string(last_) : std::string()) + " P15 B3");
}

void FakePrinter::reply(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  output_ += behaviour_.outwards ? behaviour_.outwards(text) : text;
}

void FakePrinter::say(std::string_view line) {
  reply(line);
  flush();
}

void FakePrinter::flush() {
  while (!output_.empty() && master_ >= 0) {
    const auto count = ::write(master_, output_.data(), output_.size());
    if (count <= 0) return;
    output_.erase(0, static_cast<std::size_t>(count));
  }
  output_.clear();
}

}  // namespace unicursal::test
