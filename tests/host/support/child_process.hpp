// The program itself, run as a user runs it.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal::test {

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal when a signal ended it
  std::string out, err;
};

class Child {
 public:
  /// `error_file`: where standard error goes instead of err(). `input_file`: what it reads.
  explicit Child(const std::vector<std::string>& arguments, const std::string& error_file = {},
                 const std::string& input_file = "/dev/null") {
    std::vector<char*> pointers;
    std::vector<std::string> all = {program()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    for (std::string& argument : all) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const std::string out = out_file(), err = error_file.empty() ? err_file() : error_file;
    id_ = fork();
    if (id_ < 0) throw std::runtime_error("no child process");
    if (id_ == 0) {
      setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);  // prints of tests are kept where tests end
      dup2(open(input_file.c_str(), O_RDONLY), STDIN_FILENO);
      dup2(open(out.c_str(), O_CREAT | O_WRONLY, 0600), STDOUT_FILENO);
      dup2(open(err.c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
      execv(pointers[0], pointers.data());
      _exit(127);
    }
  }
  ~Child() {
    if (id_ < 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t id() const { return id_; }
  bool running() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
  }
  std::string out() const { return read_text(out_file()); }
  std::string err() const { return read_text(err_file()); }

  Outcome wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), out(), err()};
  }

 private:
  std::string out_file() const { return folder_ / "out"; }
  std::string err_file() const { return folder_ / "err"; }

  TempFolder folder_;
  pid_t id_ = -1;
};

inline Outcome run(const std::vector<std::string>& arguments) {
  return Child(arguments).wait();
}

}  // namespace unicursal::test
