#include "host/daemon/trying_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "host/daemon/child_limits.hpp"

namespace unicursal::host {
namespace {

constexpr ChildLimits trying_limits{SIGTERM, std::uint64_t(4) << 30, 2 * 3600, 0, rlim_t(1) << 30};

/// Between fork() and execv(), where only system calls are safe.
[[noreturn]] void become(char* const* words, int output) {
  take_on(trying_limits);
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
      ::dup2(output, STDERR_FILENO) < 0)
    ::_exit(127);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
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
