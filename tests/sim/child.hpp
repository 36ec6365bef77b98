// A simulator in a process of its own, and a simple host at the other end of a real pseudo-terminal.
#pragma once

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <deque>
#include <filesystem>
#include <string>

#include "bench.hpp"
#include "sim/simulator.hpp"

namespace unicursal::sim {

inline constexpr int patience = 20000;  // ms before a test gives up on a silent child

/// A running simulator. The destructor ends it with SIGTERM unless it has ended already.
class Child {
 public:
  explicit Child(const SimulatorOptions& options) {
    std::array<int, 2> ends;
    REQUIRE(::pipe(ends.data()) == 0);
    process_ = ::fork();
    REQUIRE(process_ >= 0);
    if (process_ == 0) ::_exit(serve(options, ends[1]));
    ::close(ends[1]);
    char byte;
    while (::read(ends[0], &byte, 1) == 1 && byte != '\n') path_ += byte;
    ::close(ends[0]);
  }
  ~Child() {
    if (process_ > 0) stop();
  }

  const std::string& path() const { return path_; }
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(process_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int stop() {
    ::kill(process_, SIGTERM);
    return wait();
  }

 private:
  static int serve(const SimulatorOptions& options, int told) {
    try {
      bool first = true;  // the terminal of a cable that returns has another path, behind the same link
      return run_simulator(options, [told, &first](const std::string& path) {
        if (!std::exchange(first, false)) return;
        const std::string line = path + "\n";
        if (::write(told, line.data(), line.size()) < 0) ::_exit(9);
        ::close(told);
      });
    } catch (const std::exception&) {
      return 7;
    }
  }

  pid_t process_ = -1;
  std::string path_;
};

/// A host with a window of 127 bytes.
class Host {
 public:
  explicit Host(const std::string& path) : port_(::open(path.c_str(), O_RDWR | O_NOCTTY)) {
    REQUIRE(port_ >= 0);
  }
  ~Host() { hang_up(); }

  void hang_up() {
    if (port_ >= 0) ::close(std::exchange(port_, -1));
  }
  void write(const std::string& text) {
    REQUIRE(::write(port_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  /// Reads everything that is left, and returns whether the line is dead.
  bool lost() {
    pollfd wait{port_, POLLIN, 0};
    std::array<char, 4096> bytes;
    while (::poll(&wait, 1, patience) == 1) {
      if (::read(port_, bytes.data(), bytes.size()) <= 0) return true;
    }
    return false;
  }
  int port() const { return port_; }
  std::string read_line() {
    for (;;) {
      const auto end = pending_.find('\n');
      if (end != std::string::npos) {
        std::string line = pending_.substr(0, end);
        pending_.erase(0, end + 1);
        return line;
      }
      pollfd wait{port_, POLLIN, 0};
      REQUIRE(::poll(&wait, 1, patience) == 1);
      std::array<char, 4096> bytes;
      const auto count = ::read(port_, bytes.data(), bytes.size());
      REQUIRE(count > 0);
      pending_.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }
  /// Sends the text and returns the first line that begins so. Asks again every second, since what a host
  /// sends is lost while the line is cleared after the one before it, as the driver of a real adapter does.
  std::string ask(const std::string& text, const std::string& beginning) {
    for (int seconds = 0; seconds < patience / 1000; ++seconds) {
      write(text);
      pollfd wait{port_, POLLIN, 0};
      while (pending_.find('\n') != std::string::npos || ::poll(&wait, 1, 1000) == 1) {
        if (std::string line = read_line(); line.starts_with(beginning)) return line;
      }
    }
    FAIL("no answer to " << text);
    return {};
  }
  void expect(const std::string& wanted) {
    while (read_line() != wanted) {
    }
  }
  /// Sends commands[first…last) as lines first + 1, first + 2…, and returns when all are acknowledged.
  void stream(const std::vector<std::string>& commands, std::size_t first, std::size_t last) {
    std::size_t used = 0;
    std::deque<std::size_t> in_flight;  // length of each line in bytes
    while (first < last || !in_flight.empty()) {
      std::string burst;
      for (; first < last; ++first) {
        const std::string line =
            Bench::numbered(static_cast<std::int64_t>(first) + 1, commands[first]) + "\n";
        if (used + line.size() > 127) break;
        used += line.size();
        in_flight.push_back(line.size());
        burst += line;
      }
      if (!burst.empty()) write(burst);
      if (!read_line().starts_with("ok")) continue;
      used -= in_flight.front();
      in_flight.pop_front();
    }
  }
  void stream(const std::vector<std::string>& commands) { stream(commands, 0, commands.size()); }

 private:
  int port_;
  std::string pending_;
};

}  // namespace unicursal::sim
