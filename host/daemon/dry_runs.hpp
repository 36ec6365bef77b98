// The dry runs that clients have asked for, at most one at a time and the newest ten on the disk. Each is the
// program itself as a child process: the printer comes first, and a model that crashes a library takes the
// child with it. It writes its report, its pictures and the page that shows them (dry_run_view.hpp) into a
// folder of its own:
//
//   dry-runs/17/run.json    what list() shows
//   dry-runs/17/report.json, index.html, curve-0000.png …
//   dry-runs/next           the number of the next one
//
// Everything belongs to the loop's thread; large files are read and removed in a thread of its own.
#pragma once

#include <array>
#include <asio/awaitable.hpp>
#include <asio/io_context.hpp>
#include <asio/thread_pool.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/engine/prepared_job.hpp"

namespace unicursal::host {

struct DryRunRecord {
  enum class State { running, done, failed };

  std::uint64_t id = 0;
  std::string job;  ///< as in JobFiles
  std::optional<LayerRange> layers;
  State state = State::running;
  double percent = 0;
  std::int64_t made = 0;  ///< when it was asked for, s since 1970
  std::string reason;     ///< why it failed, a sentence
  nlohmann::json
      figures;  ///< from its report: `seconds`, `filaments`, `gaps_percent`, `wrong_percent`, `grades`
};

nlohmann::json to_json(const DryRunRecord& run);

/// The files of a dry run that are shown, by the ends of their names, and their types.
inline constexpr std::array<std::pair<std::string_view, const char*>, 5> shown_files{
    {{".png", "image/png"},
     {".json", "application/json"},
     {".html", "text/html; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".css", "text/css; charset=utf-8"}}};

class TryingProcess;

class DryRuns {
 public:
  static constexpr std::size_t most_kept = 10;

  /// Finds the runs of an earlier daemon; one that was going on then has failed. `changed` gets the event for
  /// every change.
  DryRuns(asio::io_context& loop, std::filesystem::path folder,
          std::function<void(const nlohmann::json& event)> changed);
  /// Ends the one that is going on.
  ~DryRuns();
  DryRuns(const DryRuns&) = delete;
  DryRuns& operator=(const DryRuns&) = delete;

  const std::vector<DryRunRecord>& all() const { return runs_; }
  const DryRunRecord* find(std::uint64_t id) const;
  bool running() const { return process_ != nullptr || *beginning_; }

  struct Wish {
    std::string job;
    std::filesystem::path file;
    std::optional<std::filesystem::path> profile;  ///< instead of the job's own
    std::optional<LayerRange> layers;
  };
  /// Begins one and returns its number. Throws Refused, also while another is going on.
  asio::awaitable<std::uint64_t> begin(Wish wish);
  /// Also ends it. Throws Refused.
  asio::awaitable<void> remove(std::uint64_t id);
  /// The bytes of one of its files. Throws Refused for every name that is not of such a file.
  asio::awaitable<std::string> file(std::uint64_t id, std::string name);

 private:
  std::filesystem::path folder_of(std::uint64_t id) const { return folder_ / std::to_string(id); }
  void find_older();
  std::vector<std::filesystem::path> forget_oldest();
  asio::awaitable<std::uint64_t> make_folder(DryRunRecord run);
  void note(const DryRunRecord& run);
  void announce(const DryRunRecord& run);
  DryRunRecord* found(std::uint64_t id);
  asio::awaitable<void> follow(std::uint64_t id, std::shared_ptr<TryingProcess> process);
  void hear(std::uint64_t id, const std::string& line, std::string& reason);
  asio::awaitable<void> conclude(std::uint64_t id, int status, std::string reason);

  asio::io_context& loop_;
  std::filesystem::path folder_;
  std::function<void(const nlohmann::json& event)> changed_;
  std::vector<DryRunRecord> runs_;  ///< the oldest first
  std::shared_ptr<TryingProcess> process_;
  /// Shared with begin(), which a stopped loop ends later than this.
  std::shared_ptr<bool> beginning_ = std::make_shared<bool>(false);
  std::chrono::steady_clock::time_point announced_{};
  asio::thread_pool disk_{1};
};

}  // namespace unicursal::host
