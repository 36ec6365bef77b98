#include "host/daemon/daemon.hpp"

#include <fmt/format.h>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/post.hpp>
#include <asio/use_awaitable.hpp>
#include <utility>

#include "core/text/printable.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/service_notify.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/session_json.hpp"
#include "host/job/load_job.hpp"
#include "host/job/profile.hpp"
#include "host/loop/sentence.hpp"

namespace unicursal::host {
namespace {

using Why = Refused::Why;

using nlohmann::json;
using namespace std::chrono_literals;

constexpr auto progress_interval = 250ms;  ///< between two events of progress

/// Runs `work` in the pool's thread; exceptions come back to the caller.
template <typename Work>
asio::awaitable<std::invoke_result_t<Work>> at_work(Work work) {
  co_return work();
}

template <typename Work>
auto elsewhere(asio::thread_pool& pool, Work work) {
  return asio::co_spawn(pool.get_executor(), at_work(std::move(work)), asio::use_awaitable);
}

std::string text_of(const json& event) {
  return event.dump(-1, ' ', false, json::error_handler_t::replace);
}

QueuedJob::State state_after(Ending ending) {
  switch (ending) {
    case Ending::completed:
      return QueuedJob::State::done;
    case Ending::stopped:
      return QueuedJob::State::stopped;
    case Ending::failed:
      break;
  }
  return QueuedJob::State::failed;
}

}  // namespace

Daemon::Daemon(asio::io_context& loop, const DaemonOptions& options)
    : loop_(loop),
      options_(options),
      files_(options.jobs, options.state / "files"),
      queue_(options.state / "queue.json"),
      progress_(loop) {
  if (options.profile) profile_ = load_profile(*options.profile);
  write_state(options_.state / "queue.json", queue_.text());
}

Daemon::~Daemon() {
  disk_.join();
  preparing_.join();
}

// ---- status

json Daemon::job_and_print() const {
  json now = json::object();
  if (!current_) return now;
  if (const QueuedJob* job = queue_.find(current_->id)) now["job"] = to_json(*job);
  if (current_->print && current_->print->session())
    now["print"] = to_json(current_->print->session()->status());
  return now;
}

json Daemon::status() const {
  json status = {{"version", 1}, {"state", "idle"}, {"waiting", queue_.waiting()}};
  if (current_) status["state"] = current_->print ? "printing" : "preparing";
  status.update(job_and_print());
  if (!last_.is_null()) status["last"] = last_;
  if (!problem_.empty()) status["problem"] = problem_;
  return status;
}

json Daemon::printer() const {
  json printer = {{"version", 1}, {"busy", busy()}};
  if (options_.port) printer["port"] = *options_.port;
  if (!firmware_.empty()) printer["firmware"] = core::printable(firmware_);
  const Profile* profile = profile_ ? &*profile_ : nullptr;
  if (current_ && current_->print) profile = &current_->print->prepared().job.profile;
  if (!profile) return printer;
  printer["name"] = profile->printer.name;
  printer["baud"] = profile->baud;
  printer["bed_mm"] = profile->printer.bed;
  printer["nozzle_mm"] = profile->printer.nozzle;
  if (!options_.port) printer["port"] = profile->port;
  return printer;
}

Session& Daemon::session() {
  if (!current_) throw Refused(Why::conflict, "nothing is being printed");
  if (!current_->print || !current_->print->session())
    throw Refused(Why::conflict, "the print is still being prepared");
  return *current_->print->session();
}

// ---- the queue

asio::awaitable<void> Daemon::save() {
  const auto write = [file = options_.state / "queue.json", text = queue_.text()] {
    write_state(file, text);
    return true;
  };
  co_await elsewhere(disk_, write);
}

asio::awaitable<std::uint64_t> Daemon::add(std::string name, std::optional<LayerRange> layers) {
  if (queue_.waiting() >= Queue::most_waiting) throw Refused(Why::conflict, "the queue is full");
  const auto check = [this, name] {
    const std::filesystem::path file = files_.find(name);
    try {
      load_job(file, options_.profile);
    } catch (const core::DataError& error) {
      throw Refused(Why::bad_job, error.what());
    }
    return true;
  };
  {
    // The files must not be changed between the check and the queue.
    const auto place = being_added_.insert(name);
    const std::shared_ptr<void> added(nullptr, [this, place](void*) { being_added_.erase(place); });
    co_await elsewhere(disk_, check);
  }
  const std::uint64_t id = queue_.add(std::move(name), layers);
  std::string problem;
  try {
    co_await save();
  } catch (const core::DataError& error) {
    problem = error.what();
  }
  const QueuedJob* job = queue_.find(id);
  // A job that is not on disk would be lost with this daemon, so it is refused unless it was started
  // meanwhile.
  if (!problem.empty() && job && job->state == QueuedJob::State::queued) {
    queue_.remove(id);
    throw Refused(Why::no_room, problem);
  }
  if (job) broadcast({{"event", "queue"}, {"job", to_json(*job)}});
  co_return id;
}

asio::awaitable<void> Daemon::remove(std::uint64_t id) {
  if (!queue_.find(id)) throw Refused(Why::not_found, "there is no job with that number");
  if (current_ && current_->id == id)
    throw Refused(Why::conflict, "that job is being printed; cancel it instead");
  QueuedJob removed = *queue_.find(id);
  queue_.remove(id);
  std::string problem;
  try {
    co_await save();
  } catch (const core::DataError& error) {
    problem = error.what();
  }
  if (!problem.empty()) {  // it would come back with the next daemon
    queue_.put_back(std::move(removed));
    throw Refused(Why::no_room, problem);
  }
  broadcast({{"event", "queue"}, {"removed", id}});
}

/// Files of a job that waits or is being printed must not change.
void Daemon::check_not_needed(const std::string& upload) const {
  for (const std::string& name : being_added_) {
    if (JobFiles::is_from(name, upload))
      throw Refused(Why::conflict, "a job from there is being queued; choose another name");
  }
  for (const QueuedJob& job : queue_.jobs()) {
    const bool current = current_ && current_->id == job.id;
    if ((current || job.state == QueuedJob::State::queued) && JobFiles::is_from(job.name, upload))
      throw Refused(Why::conflict, fmt::format("job {} is from there, and {}; choose another name", job.id,
                                               current ? "is being printed" : "waits"));
  }
}

asio::awaitable<void> Daemon::keep_upload(std::string upload, std::string file, std::string bytes) {
  check_not_needed(upload);
  const auto keep = [this, upload, file, bytes = std::move(bytes)] {
    files_.keep(upload, file, bytes);
    return true;
  };
  co_await elsewhere(disk_, keep);
}

asio::awaitable<void> Daemon::remove_upload(std::string upload) {
  check_not_needed(upload);
  const auto remove = [this, upload] {
    files_.remove(upload);
    return true;
  };
  co_await elsewhere(disk_, remove);
}

asio::awaitable<std::vector<std::string>> Daemon::job_names() {
  const auto list = [this] { return files_.list(); };
  co_return co_await elsewhere(disk_, list);
}

// ---- printing

std::uint64_t Daemon::start(std::optional<std::uint64_t> id) {
  if (when_idle_) throw Refused(Why::conflict, "the daemon is ending");
  if (current_) throw Refused(Why::conflict, "a print is going on");
  const QueuedJob* job = id ? queue_.find(*id) : queue_.next();
  if (!job)
    throw Refused(id ? Why::not_found : Why::conflict,
                  id ? "there is no job with that number" : "no job is waiting");
  check_port_exists();
  const std::uint64_t chosen = job->id;
  current_.emplace();
  current_->id = chosen;
  queue_.enter(chosen, QueuedJob::State::preparing);
  asio::co_spawn(
      loop_, [this, chosen]() -> asio::awaitable<void> { co_await print(chosen); }, asio::detached);
  return chosen;
}

/// Throws Refused if the printer's port is a device that is not there; then the job has not left the queue.
void Daemon::check_port_exists() const {
  const std::string port = options_.port ? *options_.port : profile_ ? profile_->port : "";
  std::error_code error;
  if (port.starts_with('/') && !std::filesystem::exists(port, error))
    throw Refused(Why::conflict,
                  "the printer's port " + core::printable(port) +
                      " is not there: plug the printer in and switch it on; the job stays in the queue");
}

/// Reads files and opens the port; blocks.
std::unique_ptr<Print> Daemon::prepared(const QueuedJob& job) const {
  PrintOptions options;
  options.port = options_.port;
  if (!options.port && profile_) options.port = profile_->port;
  if (!options.port && JobFiles::is_upload(job.name)) options.port = "auto";  // an upload may name any port
  options.spool = options_.spool;
  options.pause_heat = options_.pause_heat;
  PreparedJob prepared = prepare(load_job(files_.find(job.name), options_.profile), job.layers);
  auto print = std::make_unique<Print>(std::move(prepared), options);
  print->connect();
  return print;
}

asio::awaitable<void> Daemon::enter(std::uint64_t id, QueuedJob::State state, std::string reason) {
  queue_.enter(id, state, reason);
  const QueuedJob* entered = queue_.find(id);
  if (entered)
    log_line(
        fmt::format("job {} {}: {}{}{}", id, entered->name, name(state), reason.empty() ? "" : ": ", reason));
  if (entered && last_.contains("job") && last_["job"].value("id", id + 1) == id)
    last_["job"] = to_json(*entered);
  std::string trouble;
  try {
    co_await save();
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  problem_ = trouble;
  if (const QueuedJob* job = queue_.find(id)) broadcast({{"event", "queue"}, {"job", to_json(*job)}});
}

asio::awaitable<void> Daemon::print(std::uint64_t id) {
  auto ending = QueuedJob::State::failed;
  std::string reason;
  std::exception_ptr error;
  try {
    reason = co_await print_prepared(id, ending);
  } catch (const PortError& closed) {
    ending = QueuedJob::State::queued;
    reason = closed.what();
  } catch (...) {
    error = std::current_exception();
  }
  if (error) reason = sentence(error);
  if (current_->print) {
    last_ = current_->print->session() ? job_and_print() : json();
    current_->print->end();
    // Ending the planning threads may take long, so it happens in another thread.
    asio::post(preparing_,
               [gone = std::shared_ptr<Print>(std::move(current_->print))]() mutable { gone.reset(); });
  }
  current_.reset();
  notify_service("STATUS=idle");
  co_await enter(id, ending, reason);
  if (when_idle_) when_idle_();
}

/// Returns why the print did not complete; empty if it did.
asio::awaitable<std::string> Daemon::print_prepared(std::uint64_t id, QueuedJob::State& ending) {
  co_await enter(id, QueuedJob::State::preparing, {});
  const QueuedJob job = *queue_.find(id);
  const auto prepare = [this, job] { return prepared(job); };
  std::unique_ptr<Print> print = co_await elsewhere(preparing_, prepare);
  if (current_->cancelled) {
    ending = QueuedJob::State::stopped;
    co_return *current_->cancelled;
  }
  current_->print = std::move(print);
  Session& session = current_->print->begin(loop_.get_executor());
  session.on_event([this](const SessionEvent& event) { on_session_event(event); });
  co_await enter(id, QueuedJob::State::printing, {});
  notify_service("STATUS=printing " + core::printable(job.name));
  const StreamResult result = co_await session.run();
  firmware_ = result.firmware;
  ending = state_after(result.ending);
  // A printer that is switched off, or does not answer, is not the job's fault.
  if (result.ending == Ending::failed && !result.begun && !result.unfit) ending = QueuedJob::State::queued;
  std::string reason = result.ending == Ending::stopped ? session.status().reason : result.reason;
  if (result.ending != Ending::completed && result.begun)
    reason += "; to continue it: " + way_on() + " " + current_->print->kept_as();
  co_return reason;
}

/// The command that continues a print; a terminal may have another folder of prints.
std::string Daemon::way_on() const {
  return options_.spool ? "unicursal resume --spool " + options_.spool->string() : "unicursal resume";
}

void Daemon::cancel(const std::string& reason) {
  if (!current_) throw Refused(Why::conflict, "nothing is being printed");
  if (!current_->print || !current_->print->session()) {
    current_->cancelled = reason;
    return;
  }
  if (const Refusal no = session().cancel(reason)) throw Refused(Why::conflict, *no);
}

void Daemon::stop_at_once() {
  if (!current_) throw Refused(Why::conflict, "nothing is being printed");
  if (!current_->print || !current_->print->session()) return cancel("the user has stopped it");
  if (const Refusal no = session().emergency_stop()) throw Refused(Why::conflict, *no);
}

void Daemon::shut_down(std::function<void()> done) {
  const bool again = static_cast<bool>(when_idle_);
  when_idle_ = std::move(done);
  if (!current_) return when_idle_();
  try {
    if (again)
      stop_at_once();
    else
      cancel("the daemon was asked to end");
  } catch (const Refused&) {
    // The print is ending already.
  }
}

// ---- events

void Daemon::join(std::unique_ptr<Follower> follower) {
  std::erase_if(followers_, [](const auto& one) { return !one->open(); });
  follower->send(text_of({{"event", "hello"}, {"status", status()}}));
  followers_.push_back(std::move(follower));
}

void Daemon::broadcast(const json& event) {
  std::erase_if(followers_, [](const auto& one) { return !one->open(); });
  if (followers_.empty()) return;
  const std::string text = text_of(event);
  for (const auto& follower : followers_) follower->send(text);
}

void Daemon::on_session_event(const SessionEvent& event) {
  if (event.kind == SessionEvent::Kind::progress || event.kind == SessionEvent::Kind::heat)
    return show_progress_soon();
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  if (!session) return;
  if (event.kind == SessionEvent::Kind::state) {
    const nlohmann::json status = to_json(session->status());
    log_line("print: " + status.value("state", "") + " " + status.value("reason", ""));
  }
  if (followers_.empty()) return;
  SessionEvent shown = event;
  shown.text = event.kind == SessionEvent::Kind::printer ? core::printable(event.text) : event.text;
  broadcast(to_json(shown, session->status()));
}

/// Sends at most four events a second; the last one is never lost.
void Daemon::show_progress_soon() {
  if (progress_waits_ || followers_.empty()) return;
  progress_waits_ = true;
  progress_.expires_after(progress_interval);
  progress_.async_wait([this](const asio::error_code& cut) {
    progress_waits_ = false;
    const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
    if (!cut && session)
      broadcast(to_json(SessionEvent{SessionEvent::Kind::progress, {}}, session->status()));
  });
}

}  // namespace unicursal::host
