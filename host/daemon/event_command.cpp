#include "host/daemon/event_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <vector>

#include "host/daemon/log.hpp"
#include "host/files/descriptor.hpp"
#include "host/files/environment.hpp"

namespace unicursal::host {
namespace {

constexpr auto last_moment = std::chrono::milliseconds(700);  ///< for runs when the daemon ends
constexpr auto between_looks = std::chrono::milliseconds(50);
constexpr int event_niceness = 10;  ///< the printer comes first

/// What a program needs, and none of the secrets that this one may have been started with.
std::vector<std::string> environment_for(const CommandEvent& event) {
  std::vector<std::string> variables;
  for (const char* name : {"PATH", "HOME", "USER", "LOGNAME", "LANG", "LC_ALL", "LC_CTYPE", "TZ", "TMPDIR"}) {
    if (const auto value = environment(name)) variables.push_back(std::string(name) + "=" + *value);
  }
  variables.push_back("UNICURSAL_EVENT=" + event.name);
  variables.push_back("UNICURSAL_TEXT=" + event.sentence);
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A file in memory that holds the text, to be read from its beginning.
Descriptor file_with(const std::string& text) {
  Descriptor file(::memfd_create("event", MFD_CLOEXEC));
  const std::string line = text + "\n";
  std::size_t written = 0;
  while (file.get() >= 0 && written < line.size()) {
    const ssize_t some = ::write(file.get(), line.data() + written, line.size() - written);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) break;
    written += static_cast<std::size_t>(some);
  }
  if (written < line.size() || ::lseek(file.get(), 0, SEEK_SET) != 0)
    throw std::system_error(errno, std::generic_category(), "no memory for the event");
  return file;
}

/// In a process group of its own, with the daemon's standard error only. Throws std::system_error.
pid_t spawn_shell(const std::string& command, const CommandEvent& event) {
  const Descriptor input = file_with(event.json);
  std::vector<std::string> words{"sh", "-c", command}, variables = environment_for(event);
  std::vector<char*> arguments = pointers_to(words), settings = pointers_to(variables);
  posix_spawnattr_t attributes;
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, input.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  pid_t child = -1;
  const int error = ::posix_spawn(&child, "/bin/sh", &files, &attributes, arguments.data(), settings.data());
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::generic_category(), "no process");
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(child), event_niceness);
  return child;
}

/// Waits for the end of a child for a moment, or until it has ended.
void wait_a_moment(pid_t child) {
  const Descriptor ended(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  pollfd readable{ended.get(), POLLIN, 0};  // a negative descriptor is left out
  ::poll(&readable, 1, static_cast<int>(between_looks.count()));
}

}  // namespace

EventCommand::EventCommand(std::string command, std::chrono::milliseconds longest)
    : command_(std::move(command)),
      longest_(longest),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

EventCommand::~EventCommand() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, last_moment, [this] { return waiting_.empty() && !running_; });
  waiting_.clear();
  lock.unlock();
  thread_.request_stop();
}

void EventCommand::run(CommandEvent event) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= most_waiting) {
      log_line("--on-event: too many events wait for the command; it does not hear of " +
               waiting_.front().name);
      waiting_.pop_front();
    }
    waiting_.push_back(std::move(event));
  }
  changed_.notify_all();
}

void EventCommand::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    const CommandEvent event = std::move(waiting_.front());
    waiting_.pop_front();
    running_ = true;
    lock.unlock();
    try {
      run_one(event, stop);
    } catch (const std::system_error& error) {
      log_line(fmt::format("--on-event: the command cannot be run: {}", error.what()));
    }
    lock.lock();
    running_ = false;
    changed_.notify_all();
  }
}

void EventCommand::run_one(const CommandEvent& event, const std::stop_token& stop) const {
  await_end(spawn_shell(command_, event), event, stop);
}

void EventCommand::await_end(pid_t child, const CommandEvent& event, const std::stop_token& stop) const {
  const auto end = std::chrono::steady_clock::now() + longest_;
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(child, &status, WNOHANG)) == 0 && !stop.stop_requested() &&
         std::chrono::steady_clock::now() < end)
    wait_a_moment(child);
  if (ended == 0) {
    ::kill(-child, SIGKILL);
    ::waitpid(child, &status, 0);
    log_line(fmt::format("--on-event: the command took too long for {} and was killed", event.name));
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    log_line(fmt::format("--on-event: the command failed for {} (exit code {})", event.name,
                         WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)));
  }
}

}  // namespace unicursal::host
