// Pictures and estimates of the jobs that wait, made one after the other by child processes. The printer
// comes first: while a print has little planned ahead, nothing is begun, and a new print ends what goes on.
#include <fstream>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>

#include "core/error.hpp"
#include "core/stopping.hpp"
#include "core/text/file_bytes.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/job_sketch.hpp"
#include "host/daemon/refused.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double planned_enough = 60;  ///< s that a print must have planned ahead
constexpr auto until_next_look = std::chrono::seconds(20);

/// Removes the folders of jobs that have left the queue.
void tidy(const fs::path& root, const std::set<std::string>& kept) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator item(root, error), end; !error && item != end; item.increment(error)) {
    if (!kept.contains(item->path().filename().string())) old.push_back(item->path());
  }
  for (const fs::path& folder : old) fs::remove_all(folder, error);
}

/// Null: there is none.
json estimate_in(const fs::path& folder) {
  std::ifstream file(folder / sketch_estimate);
  const json estimate = json::parse(file, nullptr, false);
  return estimate.is_object() ? estimate : json();
}

}  // namespace

bool Daemon::may_sketch() const {
  if (when_idle_) return false;
  if (!current_) return true;
  return in_session() && current_->print->session()->status().lookahead >= planned_enough;
}

void Daemon::sketch_soon() {
  if (sketching_) return;
  sketching_ = true;
  asio::co_spawn(
      loop_, [this]() -> asio::awaitable<void> { co_await sketch_waiting(); }, asio::detached);
}

/// The first waiting job that has no estimate yet, or null.
const QueuedJob* Daemon::next_to_sketch() const {
  for (const QueuedJob& job : queue_.jobs()) {
    if (job.state == QueuedJob::State::queued && job.estimate.is_null() && !not_sketched_.contains(job.id))
      return &job;
  }
  return nullptr;
}

asio::awaitable<void> Daemon::sketch_waiting() {
  std::set<std::string> kept;
  for (const QueuedJob& job : queue_.jobs()) kept.insert(std::to_string(job.id));
  const auto tidied = [root = options_.state / "sketches", kept] { return tidy(root, kept), true; };
  co_await elsewhere(disk_, tidied);
  while (const QueuedJob* job = next_to_sketch()) {
    if (!may_sketch()) {
      sketch_timer_.expires_after(until_next_look);
      sketch_timer_.async_wait([this](const asio::error_code& cut) {
        if (!cut) sketch_soon();
      });
      break;
    }
    const std::uint64_t id = job->id;
    json estimate = co_await sketch(*job);
    if (!queue_.find(id)) continue;
    if (estimate.is_null()) {
      if (may_sketch()) not_sketched_.insert(id);
      continue;
    }
    queue_.estimate(id, std::move(estimate));
    try {
      co_await save();
    } catch (const core::DataError&) {
      // It is made again by the next daemon.
    }
    if (const QueuedJob* now = queue_.find(id)) broadcast({{"event", "queue"}, {"job", to_json(*now)}});
  }
  sketching_ = false;
}

/// Null: none could be made.
asio::awaitable<json> Daemon::sketch(QueuedJob job) {
  const fs::path folder = options_.state / "sketches" / std::to_string(job.id);
  try {
    JobCheck check = check_of(job.name, job.layers);
    check.limits = options_.upload_limits;
    check.sketch = folder;
    const auto made = [folder] { return fs::create_directories(folder); };
    co_await elsewhere(disk_, made);
    if (!may_sketch()) co_return json();
    sketch_stop_ = {};
    co_await check_in_child(check, sketch_stop_.get_token());
    const auto read = [folder] { return estimate_in(folder); };
    co_return co_await elsewhere(disk_, read);
  } catch (const core::Stopped&) {
    co_return json();
  } catch (const std::exception&) {
    co_return json();
  }
}

asio::awaitable<std::string> Daemon::job_picture(std::uint64_t id) {
  if (!queue_.find(id)) throw Refused(Refused::Why::not_found, "there is no job with that number");
  const fs::path file = options_.state / "sketches" / std::to_string(id) / sketch_picture;
  const auto read = [file]() -> std::string {
    std::error_code error;
    return fs::is_regular_file(file, error) ? core::file_bytes(file) : std::string();
  };
  std::string bytes = co_await elsewhere(disk_, read);
  if (bytes.empty()) throw Refused(Refused::Why::not_found, "that job has no picture yet");
  co_return bytes;
}

}  // namespace unicursal::host
