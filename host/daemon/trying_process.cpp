#include "host/daemon/trying_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace unicursal::host {
namespace {

constexpr rlim_t most_trying_memory = rlim_t(4) << 30;   ///< address space, bytes
constexpr rlim_t most_trying_seconds = 2 * 3600;         ///< of the processor
constexpr rlim_t largest_trying_file = rlim_t(1) << 30;  ///< bytes

void restrict_to(__rlimit_resource which, rlim_t most) {
  const rlimit limits{most, most};
  ::setrlimit(which, &limits);
}

/// Between fork() and execv(), where only system calls are safe.
[[noreturn]] void become(char* const* words, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::setpriority(PRIO_PROCESS, 0, 19);
  restrict_to(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__  // the sanitizer itself reserves terabytes of addresses
  restrict_to(RLIMIT_AS, most_trying_memory);
#endif
  restrict_to(RLIMIT_CPU, most_trying_seconds);
  restrict_to(RLIMIT_FSIZE, largest_trying_file);
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
      ::dup2(output, STDERR_FILENO) < 0)
    ::_exit(127);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  const int score = ::open("/proc/self/oom_score_adj", O_WRONLY);  // it goes before the daemon does
  if (score >= 0 && ::write(score, "1000", 4) == 4) ::close(score);
  ::execv("/proc/self/exe", words);
  ::_exit(127);
}

}  // namespace

TryingProcess::TryingProcess(std::vector<std::string> words) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "no pipe");
  read_end_.reset(ends[0]);
  const Descriptor write_end(ends[1]);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  id_ = ::fork();
  if (id_ == 0) become(arguments.data(), write_end.get());
  if (id_ < 0) throw std::system_error(errno, std::generic_category(), "no process for the dry run");
}

TryingProcess::~TryingProcess() {
  if (id_ <= 0) return;
  end();
  kill();
  ::waitpid(id_, nullptr, 0);
}

void TryingProcess::end() const {
  ended_ = true;
  if (id_ > 0) ::kill(id_, SIGTERM);
}

void TryingProcess::kill() const {
  if (id_ > 0) ::kill(id_, SIGKILL);
}

int TryingProcess::wait() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  return status;
}

}  // namespace unicursal::host
