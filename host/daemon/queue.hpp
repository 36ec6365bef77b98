// The jobs of a daemon, in the order in which they are to be printed, and what became of the last ones.
// Whoever changes them writes text() to the queue's file, off the loop, so that a daemon that is killed finds
// them again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/prepared_job.hpp"

namespace unicursal::host {

struct QueuedJob {
  enum class State {
    queued,
    preparing,  ///< is read and checked, the port is opened
    printing,   ///< until the printer is cold, pauses included
    done,
    stopped,  ///< by the user
    failed,
    interrupted  ///< the daemon was gone before the end
  };

  std::uint64_t id = 0;
  std::string name;  ///< as JobFiles knows it
  std::optional<LayerRange> layers;
  State state = State::queued;
  std::string reason;      ///< of an end that is no good one, a sentence
  std::int64_t added = 0;  ///< s since 1970
  std::int64_t began = 0, ended = 0;
};

const char* name(QueuedJob::State state);

class Queue {
 public:
  static constexpr std::size_t most_waiting = 1000;
  static constexpr std::size_t most_kept = 100;  ///< of those that have ended

  /// Reads what an earlier daemon has left, if it has; jobs that it was at become interrupted. Throws
  /// DaemonError for a file that is none of its kind.
  explicit Queue(const std::filesystem::path& file);

  const std::vector<QueuedJob>& jobs() const { return jobs_; }
  const QueuedJob* find(std::uint64_t id) const;
  /// The first that waits, or null.
  const QueuedJob* next() const;
  std::size_t waiting() const;

  std::uint64_t add(std::string name, std::optional<LayerRange> layers);
  void remove(std::uint64_t id);
  /// Precondition: it is there.
  void enter(std::uint64_t id, QueuedJob::State state, const std::string& reason = {});
  /// What the file is to hold.
  std::string text() const;

 private:
  void forget_oldest();

  std::uint64_t next_id_ = 1;
  std::vector<QueuedJob> jobs_;
};

nlohmann::json to_json(const QueuedJob& job);

}  // namespace unicursal::host
