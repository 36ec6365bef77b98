// The daemon's own mind: a queue of jobs, at most one print, and who listens to it. It knows nothing of HTTP
// (api.hpp) and nothing of signals (serve.hpp). Everything belongs to the loop's thread; files and planning
// are at work in threads of their own.
//
// A print is never begun by itself: somebody has to have taken the last part off the bed.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/daemon/job_files.hpp"
#include "host/daemon/queue.hpp"
#include "host/engine/print.hpp"
#include "host/http/event_stream.hpp"

namespace unicursal::host {

struct DaemonOptions {
  std::filesystem::path state;                   ///< folder (state_folder.hpp)
  std::vector<std::filesystem::path> jobs;       ///< folders of jobs
  std::optional<std::string> port;               ///< absent: the profile's
  std::optional<std::filesystem::path> profile;  ///< of the printer, instead of the jobs' own
  std::optional<std::filesystem::path> spool;    ///< folder of the prints
  PauseHeat pause_heat = PauseHeat::keep;
};

class Daemon {
 public:
  /// Throws core::DataError: a profile that cannot be read, a folder that is none, a damaged queue.
  Daemon(asio::io_context& loop, const DaemonOptions& options);
  ~Daemon();

  nlohmann::json status() const;
  nlohmann::json printer() const;
  const Queue& queue() const { return queue_; }
  const JobFiles& files() const { return files_; }

  /// The session of a print that is not over. Throws HttpError 409.
  Session& session();
  /// Checks the job's text first. Throws HttpError 400, 404, 409, 422 or 507.
  asio::awaitable<std::uint64_t> add(std::string name, std::optional<LayerRange> layers);
  /// Throws HttpError 404 or 409.
  asio::awaitable<void> remove(std::uint64_t id);
  /// Not while a job from there is printed: it is checked only once. Throws HttpError 400, 409 or 507.
  asio::awaitable<void> keep_upload(std::string upload, std::string file, std::string bytes);
  asio::awaitable<void> remove_upload(std::string upload);
  asio::awaitable<std::vector<std::string>> job_names();
  /// Begins to prepare and then prints; `id` absent: the first that waits. Returns at once. Throws HttpError
  /// 404 or 409.
  std::uint64_t start(std::optional<std::uint64_t> id);
  /// Also while it prepares. Throws HttpError 409.
  void cancel(const std::string& reason);
  void stop_at_once();

  /// Tells it of every event from now on.
  void join(std::shared_ptr<EventStream> client);
  /// No further print begins; the present one is parked and cooled, or stopped at once if asked for again.
  /// `done` is called when nothing prints any more.
  void shut_down(std::function<void()> done);
  bool busy() const { return current_.has_value(); }

 private:
  struct Current {
    std::uint64_t id = 0;
    std::unique_ptr<Print> print;          ///< once it is prepared
    std::optional<std::string> cancelled;  ///< why, before that
  };

  asio::awaitable<void> print(std::uint64_t id);
  asio::awaitable<std::string> print_prepared(std::uint64_t id, QueuedJob::State& ending);
  std::unique_ptr<Print> prepared(const QueuedJob& job) const;
  void check_not_needed(const std::string& upload) const;
  std::string way_on() const;
  asio::awaitable<void> save();
  asio::awaitable<void> enter(std::uint64_t id, QueuedJob::State state, std::string reason);
  void told(const SessionEvent& event);
  void broadcast(const nlohmann::json& event);
  void show_progress_soon();
  nlohmann::json job_and_print() const;

  asio::io_context& loop_;
  const DaemonOptions options_;
  std::optional<Profile> profile_;
  JobFiles files_;
  Queue queue_;
  std::optional<Current> current_;
  nlohmann::json last_;   ///< the final status of the print before, or null
  std::string firmware_;  ///< of the printer, as last heard
  std::string problem_;   ///< of the state folder
  std::function<void()> when_idle_;
  std::vector<std::shared_ptr<EventStream>> clients_;
  asio::steady_timer progress_;
  bool progress_waits_ = false;
  asio::thread_pool disk_{1}, preparing_{1};
};

}  // namespace unicursal::host
