#include "host/daemon/job_check.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/read.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>
#include <cerrno>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <set>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/stopping.hpp"
#include "host/daemon/child_limits.hpp"
#include "host/daemon/job_sketch.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/files/descriptor.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t longest_sentence = 64 * 1024;  ///< bytes that are taken from a child
constexpr auto grace = std::chrono::seconds(1);  ///< for a child to report by itself that its time is over
constexpr std::uint64_t megabyte = 1024 * 1024;

std::string too_slow(const CheckLimits& limits) {
  return fmt::format(
      "the job takes longer than {} s to read; simplify its model, or start the daemon with more "
      "--check-time",
      limits.time.value_or(std::chrono::seconds(0)).count());
}

std::string too_large(const CheckLimits& limits) {
  return fmt::format(
      "the job needs more than {} MB of memory; simplify its model, or start the daemon with more "
      "--check-memory",
      limits.memory.value_or(0) / megabyte);
}

// ---- in the child

/// The first curve of every island is enough: what remains is the optimiser's work, which can be stopped.
void plan_roughly(const PreparedJob& prepared, std::size_t index) {
  LookaheadOptions options = lookahead_options(prepared);
  options.plan.budget_spent = [] { return true; };
  options.plan.threads = 1;
  const core::Layer layer = prepared.part->layer(index);
  for (const core::Island& island : layer.islands) prepared.planner->plan(island, layer.z, options.plan);
}

/// Asks to stop when a time is over; ends with this object.
class Alarm {
 public:
  explicit Alarm(std::chrono::milliseconds time)
      : thread_([this, time](const std::stop_token& over) {
          std::unique_lock lock(mutex_);
          const bool done = ended_.wait_for(lock, over, time, [&over] { return over.stop_requested(); });
          if (!done) source_.request_stop();
        }) {}
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread thread_;
};

/// Plans and slices for as long as `time`.
void probe(const PreparedJob& prepared, std::chrono::milliseconds time) {
  const Alarm alarm(time);
  const core::StopScope scope(alarm.token());
  const std::size_t last = prepared.first + prepared.count - 1;
  try {
    for (const std::size_t index : std::set{prepared.first, prepared.first + prepared.count / 2, last})
      plan_roughly(prepared, index);
    for (std::size_t index = prepared.first; index <= last; ++index) prepared.part->layer(index);
  } catch (const core::Stopped&) {
    // It is a large job, and sound so far.
  }
}

// ---- in the daemon

/// A child whose standard error can be read. The destructor kills it.
class Child {
 public:
  explicit Child(std::vector<std::string> words) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "no pipe");
    read_end_.reset(ends[0]);
    const Descriptor write_end(ends[1]);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    // The daemon ignores some signals, such as the one of the limit on processor time.
    posix_spawnattr_t attributes;
    sigset_t all;
    sigfillset(&all);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, write_end.get(), STDERR_FILENO);
    // Asio's sockets do not close themselves in a child.
    ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    const int error = ::posix_spawn(&id_, "/proc/self/exe", &files, &attributes, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    if (error != 0) throw std::system_error(error, std::generic_category(), "no process to check the job");
  }
  ~Child() {
    kill();
    if (id_ > 0) ::waitpid(id_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int release_output() { return read_end_.release(); }
  void kill() const {
    if (id_ > 0) ::kill(id_, SIGKILL);
  }
  /// As waitpid() gives it. The child has closed its output, and is ending.
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  Descriptor read_end_;
  pid_t id_ = -1;
};

std::vector<std::string> words_for(const JobCheck& check) {
  std::vector<std::string> words{"unicursal", "check-job", check.job.string()};
  if (check.profile) words.insert(words.end(), {"--profile", check.profile->string()});
  if (check.layers)
    words.insert(words.end(), {"--layers", fmt::format("{}:{}", check.layers->first, check.layers->last)});
  if (check.sketch) words.insert(words.end(), {"--sketch", check.sketch->string()});
  if (check.limits.memory)
    words.insert(words.end(), {"--memory", std::to_string(*check.limits.memory / megabyte)});
  if (check.limits.time) words.insert(words.end(), {"--time", std::to_string(check.limits.time->count())});
  return words;
}

/// What a child has said: notes, and behind them the refusal, which comes first here.
std::string in_one_sentence(const std::string& said) {
  constexpr std::string_view refusal_mark = "unicursal: ", note_mark = "note: ";
  constexpr std::size_t most_notes = 3;
  std::string refusal, notes;
  std::size_t count = 0;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(refusal_mark)) {
      refusal += line.substr(refusal_mark.size());
    } else if (line.starts_with(note_mark)) {
      if (++count <= most_notes) notes += (notes.empty() ? "" : "; ") + line.substr(note_mark.size());
    } else {
      refusal += line;
    }
  }
  if (count > most_notes) notes += fmt::format("; and {} more notes", count - most_notes);
  return notes.empty() ? refusal : refusal + " (noted before: " + notes + ")";
}

std::string verdict(const JobCheck& check, int status, const std::string& output, bool late) {
  const std::string said = in_one_sentence(output);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (late || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)))
    return too_slow(check.limits);
  if (WIFEXITED(status) && !said.empty()) return said;
  return fmt::format("{}: the program fails when it reads this job (signal {}); simplify its model",
                     check.job.filename().string(), WIFSIGNALED(status) ? WTERMSIG(status) : 0);
}

}  // namespace

asio::awaitable<std::string> check_in_child(JobCheck check, std::stop_token stop) {
  const auto executor = co_await asio::this_coro::executor;
  // The timer's handler may run after this coroutine has ended.
  struct Shared {
    explicit Shared(std::vector<std::string> words) : child(std::move(words)) {}
    Child child;
    bool late = false;
  };
  const auto shared = std::make_shared<Shared>(words_for(check));
  Child& child = shared->child;
  asio::posix::stream_descriptor output(executor, child.release_output());
  asio::steady_timer timer(executor);
  if (check.limits.time) {
    timer.expires_after(*check.limits.time + grace);
    timer.async_wait([shared](const asio::error_code& cut) {
      if (cut) return;
      shared->late = true;
      shared->child.kill();
    });
  }
  std::string said;
  {
    const std::stop_callback killing(stop, [&child] { child.kill(); });
    asio::error_code ended;
    co_await asio::async_read(output, asio::dynamic_buffer(said, longest_sentence), asio::transfer_all(),
                              asio::redirect_error(asio::use_awaitable, ended));
  }
  timer.cancel();
  if (said.size() == longest_sentence) child.kill();
  const int status = child.wait();
  if (stop.stop_requested()) throw core::Stopped();
  co_return verdict(check, status, said, shared->late);
}

void check_here(const JobCheck& check) {
  ChildLimits limits{SIGKILL, check.limits.memory, {}, 1, {}};
  if (check.limits.time) limits.soft_seconds = static_cast<rlim_t>(check.limits.time->count());
  take_on(limits);
  try {
    Job job = load_job_or_model(check.job, check.profile, UnnamedPrinter::refuse);
    if (job.sliced) {
      const PreparedSliced prepared = prepare_sliced(std::move(job), check.layers);
      if (check.sketch) write_sketch(*check.sketch, prepared);
      return;
    }
    const PreparedJob prepared = prepare(std::move(job), check.layers);
    if (check.sketch) return write_sketch(*check.sketch, prepared);
    check_beginning(prepared);
    if (check.limits.time) probe(prepared, *check.limits.time / 2);
  } catch (const std::bad_alloc&) {
    throw core::DataError("", "", too_large(check.limits), "");
  }
}

}  // namespace unicursal::host
