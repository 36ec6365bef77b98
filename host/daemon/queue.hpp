// The jobs of a daemon in the order in which they will be printed, and the last ones that have ended. After
// every change the caller writes text() to the queue's file, off the loop, so that the next daemon finds them
// after a kill.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/prepared_job.hpp"

namespace unicursal::host {

struct QueuedJob {
  enum class State {
    queued,
    preparing,  ///< the job is read and checked, and the port opened
    printing,   ///< until the printer is cold, pauses included
    done,
    stopped,  ///< by the user
    failed,
    interrupted  ///< the daemon was gone before the end
  };

  std::uint64_t id = 0;
  std::string name;  ///< as in JobFiles
  std::optional<LayerRange> layers;
  bool to_print = false;  ///< it was sent to be printed at once (DaemonOptions::start_uploads)
  State state = State::queued;
  std::string reason;      ///< why it was not completed, a sentence; empty if it was
  std::int64_t added = 0;  ///< s since 1970
  std::int64_t began = 0, ended = 0;
  nlohmann::json estimate;  ///< as of host/report/estimate.hpp; null: not known
};

const char* name(QueuedJob::State state);

class Queue {
 public:
  static constexpr std::size_t most_waiting = 1000;
  static constexpr std::size_t most_kept = 100;  ///< jobs that have ended

  /// Reads the file of an earlier daemon if there is one; jobs that were being printed become interrupted.
  /// Throws DaemonError if it is not a queue.
  explicit Queue(const std::filesystem::path& file);

  const std::vector<QueuedJob>& jobs() const { return jobs_; }
  const QueuedJob* find(std::uint64_t id) const;
  /// The first waiting job, or null.
  const QueuedJob* next() const;
  /// The first waiting one that was sent to be printed; null if there is none.
  const QueuedJob* next_to_print() const;
  std::size_t waiting() const;

  std::uint64_t add(std::string name, std::optional<LayerRange> layers, bool to_print = false);
  /// Returns the job's place.
  std::size_t remove(std::uint64_t id);
  /// Undoes remove().
  void put_back(QueuedJob job, std::size_t place);
  /// The waiting jobs stand in this order, and those that it does not name behind them, as before. False, and
  /// nothing is changed, if one of these does not wait or is there twice.
  bool arrange(const std::vector<std::uint64_t>& ids);
  /// The numbers of the waiting jobs, in order.
  std::vector<std::uint64_t> order() const;
  /// Changes a job's state. Precondition: the job exists.
  void enter(std::uint64_t id, QueuedJob::State state, const std::string& reason = {});
  /// What a job is expected to take. Precondition: the job exists.
  void estimate(std::uint64_t id, nlohmann::json estimate);
  /// The content of the file.
  std::string text() const;

 private:
  void forget_oldest();

  std::uint64_t next_id_ = 1;
  std::vector<QueuedJob> jobs_;
};

nlohmann::json to_json(const QueuedJob& job);

}  // namespace unicursal::host
