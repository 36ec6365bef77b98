// The program in a real terminal, as a person sees it.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/host/support/screen.hpp"
#include "tests/paths.hpp"

namespace unicursal::test {

struct TerminalKind {
  unsigned short columns = 100;
  std::map<std::string, std::string> environment = {};  ///< TERM and the like; without: a monochrome xterm
  std::string program = test::program();                ///< or a shell, found in PATH
};

/// The program in a terminal of its own.
class Terminal {
 public:
  /// `config`: the folder of the user's settings.
  explicit Terminal(std::vector<std::string> arguments, const std::string& config = "/nonexistent",
                    const TerminalKind& kind = {})
      : screen_(kind.columns) {
    arguments.insert(arguments.begin(), kind.program);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const winsize size{24, kind.columns, 0, 0};
    id_ = forkpty(&master_, nullptr, nullptr, &size);
    if (id_ < 0) throw std::runtime_error("no terminal");
    if (id_ == 0) {
      setenv("XDG_CONFIG_HOME", config.c_str(), 1);
      unsetenv("COLORTERM");
      unsetenv("NO_COLOR");
      setenv("TERM", "xterm", 1);
      for (const auto& [name, value] : kind.environment) setenv(name.c_str(), value.c_str(), 1);
      execvp(pointers[0], pointers.data());
      _exit(127);
    }
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    if (id_ > 0) kill(id_, SIGKILL), waitpid(id_, nullptr, 0);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& text) {
    REQUIRE(write(master_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  /// Waits until the program has written the text after what was awaited before, two minutes at most.
  void await(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    for (std::size_t at = written_.find(text); at == std::string::npos; at = written_.find(text)) {
      INFO(written_);
      REQUIRE(read_some());
      REQUIRE(std::chrono::steady_clock::now() < end);
    }
    written_.erase(0, written_.find(text) + text.size());
  }
  /// What a person sees by now, also above the window.
  const Screen& screen() const { return screen_; }
  void resize(unsigned short columns) {
    const winsize size{24, columns, 0, 0};
    REQUIRE(ioctl(master_, TIOCSWINSZ, &size) == 0);
    screen_.resize(columns);
  }
  /// Waits for the end of the program, two minutes at most, and returns its exit code.
  int wait() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (read_some()) {
      INFO(written_);
      REQUIRE(std::chrono::steady_clock::now() < end);
    }
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  /// Returns false if the program has closed the terminal.
  bool read_some() {
    pollfd end{master_, POLLIN, 0};
    poll(&end, 1, 100);
    char bytes[4096];
    const ssize_t count = read(master_, bytes, sizeof bytes);
    if (count > 0) {
      const std::string text(bytes, static_cast<std::size_t>(count));
      written_ += text;
      screen_.feed(text);
    }
    return count > 0 || (count < 0 && errno == EAGAIN);
  }

  pid_t id_ = -1;
  int master_ = -1;
  std::string written_;  ///< since what was awaited last
  Screen screen_;
};

}  // namespace unicursal::test
