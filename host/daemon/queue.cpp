#include "host/daemon/queue.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
using State = QueuedJob::State;

constexpr State all_states[] = {State::queued,  State::preparing, State::printing,   State::done,
                                State::stopped, State::failed,    State::interrupted};

constexpr const char* estimate_keys[] = {"seconds", "grams", "layer_count"};

bool is_over(const QueuedJob& job) {
  return job.state != State::queued && job.state != State::preparing && job.state != State::printing;
}

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

QueuedJob job_from(const json& entry) {
  QueuedJob job;
  job.id = entry.at("id").get<std::uint64_t>();
  job.name = entry.at("job").get<std::string>();
  const std::string word = entry.at("state").get<std::string>();
  for (const State state : all_states) {
    if (word == name(state)) job.state = state;
  }
  job.to_print = entry.value("to_print", false);
  job.reason = entry.value("reason", "");
  job.added = entry.value("added", std::int64_t{0});
  job.began = entry.value("began", std::int64_t{0});
  job.ended = entry.value("ended", std::int64_t{0});
  if (entry.contains("layer_count")) {
    for (const char* key : estimate_keys) {
      if (entry.contains(key)) job.estimate[key] = entry[key];
    }
  }
  if (const auto layers = entry.find("layers"); layers != entry.end())
    job.layers = LayerRange{layers->at(0).get<std::size_t>(), layers->at(1).get<std::size_t>()};
  return job;
}

}  // namespace

const char* name(State state) {
  switch (state) {
    case State::queued:
      return "queued";
    case State::preparing:
      return "preparing";
    case State::printing:
      return "printing";
    case State::done:
      return "done";
    case State::stopped:
      return "stopped";
    case State::failed:
      return "failed";
    case State::interrupted:
      break;
  }
  return "interrupted";
}

json to_json(const QueuedJob& job) {
  json entry = {{"id", job.id}, {"job", job.name}, {"state", name(job.state)}, {"added", job.added}};
  if (job.to_print) entry["to_print"] = true;
  if (job.layers) entry["layers"] = {job.layers->first, job.layers->last};
  if (!job.reason.empty()) entry["reason"] = job.reason;
  if (job.began != 0) entry["began"] = job.began;
  if (job.ended != 0) entry["ended"] = job.ended;
  if (job.estimate.is_object()) entry.update(job.estimate);
  return entry;
}

Queue::Queue(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) return;
  try {
    const json stored = json::parse(stream);
    next_id_ = stored.at("next_id").get<std::uint64_t>();
    for (const json& entry : stored.at("jobs")) jobs_.push_back(job_from(entry));
  } catch (const json::exception&) {
    throw DaemonError(file.string(), "", "is not a queue of this program",
                      "move it away; the jobs in it have to be queued again");
  }
  for (QueuedJob& job : jobs_) {
    if (job.state != State::preparing && job.state != State::printing) continue;
    const bool printed = job.state == State::printing;
    job.state = State::interrupted;
    job.ended = now();
    job.reason = printed ? "the daemon ended while it was being printed; `unicursal resume` continues it"
                         : "the daemon ended before the print began";
  }
}

const QueuedJob* Queue::find(std::uint64_t id) const {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [id](const QueuedJob& j) { return j.id == id; });
  return job == jobs_.end() ? nullptr : &*job;
}

const QueuedJob* Queue::next() const {
  const auto waits = [](const QueuedJob& job) { return job.state == State::queued; };
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), waits);
  return job == jobs_.end() ? nullptr : &*job;
}

std::size_t Queue::waiting() const {
  return static_cast<std::size_t>(std::count_if(
      jobs_.begin(), jobs_.end(), [](const QueuedJob& job) { return job.state == State::queued; }));
}

const QueuedJob* Queue::next_to_print() const {
  const auto waits = [](const QueuedJob& job) { return job.state == State::queued && job.to_print; };
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), waits);
  return job == jobs_.end() ? nullptr : &*job;
}

std::uint64_t Queue::add(std::string name, std::optional<LayerRange> layers, bool to_print) {
  QueuedJob job;
  job.id = next_id_++;
  job.name = std::move(name);
  job.layers = layers;
  job.to_print = to_print;
  job.added = now();
  jobs_.push_back(std::move(job));
  return jobs_.back().id;
}

std::size_t Queue::remove(std::uint64_t id) {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [id](const QueuedJob& j) { return j.id == id; });
  const auto place = static_cast<std::size_t>(job - jobs_.begin());
  if (job != jobs_.end()) jobs_.erase(job);
  return place;
}

void Queue::put_back(QueuedJob job, std::size_t place) {
  const auto at = static_cast<std::ptrdiff_t>(std::min(place, jobs_.size()));
  jobs_.insert(jobs_.begin() + at, std::move(job));
}

std::vector<std::uint64_t> Queue::order() const {
  std::vector<std::uint64_t> ids;
  for (const QueuedJob& job : jobs_) {
    if (job.state == State::queued) ids.push_back(job.id);
  }
  return ids;
}

bool Queue::arrange(const std::vector<std::uint64_t>& ids) {
  std::vector<std::uint64_t> wanted = ids, left = order();
  for (const std::uint64_t id : ids) {
    const auto found = std::find(left.begin(), left.end(), id);
    if (found == left.end()) return false;
    left.erase(found);
  }
  wanted.insert(wanted.end(), left.begin(), left.end());
  std::vector<QueuedJob> moved;
  for (const std::uint64_t id : wanted) moved.push_back(*find(id));
  // The jobs that do not wait stay where they are.
  auto next = moved.begin();
  for (QueuedJob& job : jobs_) {
    if (job.state == State::queued) job = std::move(*next++);
  }
  return true;
}

void Queue::enter(std::uint64_t id, State state, const std::string& reason) {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [id](const QueuedJob& j) { return j.id == id; });
  assert(job != jobs_.end());
  job->state = state;
  job->reason = reason;
  if (state == State::preparing) job->began = now();
  if (is_over(*job)) job->ended = now();
  forget_oldest();
}

void Queue::estimate(std::uint64_t id, json estimate) {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [id](const QueuedJob& j) { return j.id == id; });
  assert(job != jobs_.end());
  job->estimate = std::move(estimate);
}

void Queue::forget_oldest() {
  std::size_t ended = static_cast<std::size_t>(std::count_if(jobs_.begin(), jobs_.end(), is_over));
  std::erase_if(jobs_, [&](const QueuedJob& job) { return is_over(job) && ended-- > most_kept; });
}

std::string Queue::text() const {
  json entries = json::array();
  for (const QueuedJob& job : jobs_) entries.push_back(to_json(job));
  const json all = {{"version", 1}, {"next_id", next_id_}, {"jobs", entries}};
  return all.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace unicursal::host
