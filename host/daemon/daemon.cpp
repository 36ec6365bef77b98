#include "host/daemon/daemon.hpp"

#include <fmt/format.h>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/post.hpp>
#include <asio/use_awaitable.hpp>
#include <utility>

#include "core/model/file_kind.hpp"
#include "core/stopping.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/service_notify.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/session_json.hpp"
#include "host/files/state_home.hpp"
#include "host/job/load_job.hpp"
#include "host/job/profile.hpp"
#include "host/job/sliced_file.hpp"
#include "host/loop/sentence.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

std::string text_of(const json& event) {
  return event.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Empty: the user has no home folder.
std::filesystem::path folder_of_prints(const DaemonOptions& options) {
  if (options.spool) return *options.spool;
  const auto home = state_home();
  return home ? *home / "prints" : std::filesystem::path();
}

}  // namespace

Daemon::Daemon(asio::io_context& loop, const DaemonOptions& options)
    : loop_(loop),
      options_(options),
      files_(options.jobs, options.state / "files"),
      queue_(options.state / "queue.json"),
      past_prints_(folder_of_prints(options),
                   [this](const std::string& trouble) {
                     asio::post(loop_, [this, trouble] { note_history(trouble); });
                   }),
      sketch_timer_(loop),
      dry_runs_(loop, options.state / "dry-runs", [this](const json& event) { broadcast(event); }),
      progress_(loop),
      idle_(loop.get_executor(), opening_.get_executor()),
      idle_shown_(loop) {
  if (options.profile) profile_ = load_profile(*options.profile);
  load_own_profile();
  watch_idle_printer();
  write_state(options_.state / "queue.json", queue_.text());
  interrupted_ = interrupted_print(options_.state);
  if (interrupted_) log_line(fmt::format("job {} {}: interrupted", interrupted_->id, interrupted_->job));
  if (options.on_event) event_command_.emplace(*options.on_event);
  sketch_soon();
}

Daemon::~Daemon() {
  if (current_) current_->preparing.request_stop();
  idle_.on_change(nullptr);
  idle_.on_line(nullptr);
  opening_.join();
  looking_.join();
  disk_.join();
  preparing_.join();
  ending_.join();
}

/// When a print was added to the history; empty: without trouble.
void Daemon::note_history(const std::string& trouble) {
  if (trouble.empty() && history_problem_.empty()) return;
  history_problem_ = trouble;
  if (!trouble.empty()) {
    announce("problem", {}, trouble);
    log_record_.note(LogRecord::From::notice, trouble);
  }
  broadcast_status();
}

// ---- status

json Daemon::job_and_print() const {
  json now = json::object();
  if (!current_) return now;
  if (const QueuedJob* job = queue_.find(current_->id)) now["job"] = to_json(*job);
  if (current_->print && current_->print->session())
    now["print"] = to_json(current_->print->session()->status());
  else if (!current_->last_status.is_null())
    now["print"] = current_->last_status;
  return now;
}

json Daemon::status() const {
  json status = {{"version", 1}, {"state", "idle"}, {"waiting", queue_.waiting()}};
  if (current_) status["state"] = current_->print ? "printing" : "preparing";
  if (current_ && current_->reconnecting) status["state"] = "reconnecting";
  status.update(job_and_print());
  if (interrupted_ && !current_) {
    json& print = status["interrupted"];
    print = {{"job", interrupted_->job},
             {"id", interrupted_->id},
             {"print", interrupted_->folder.filename().string()}};
    if (!interrupted_->question.empty()) print["question"] = interrupted_->question;
  }
  if (!last_.is_null()) status["last"] = last_;
  if (const IdleStatus idle = idle_.status(); !current_ && idle.connection == IdleStatus::Connection::open)
    status["idle"] = idle_heat(idle.temperatures);
  status["bed_clear"] = bed_clear_;
  if (const std::string& problem = problem_.empty() ? history_problem_ : problem_; !problem.empty())
    status["problem"] = problem;
  return status;
}

json Daemon::printer() const {
  json printer = {{"version", 1}, {"busy", busy()}};
  if (options_.port) printer["port"] = *options_.port;
  if (!firmware_.empty()) printer["firmware"] = core::printable(firmware_);
  const Profile* profile = own();
  if (current_ && current_->print) profile = &current_->print->job().profile;
  if (chosen_port_) printer["port"] = *chosen_port_;
  if (!profile) return add_idle(printer), printer;
  printer["name"] = profile->printer.name;
  printer["baud"] = profile->baud;
  printer["bed_mm"] = profile->printer.bed;
  printer["nozzle_mm"] = profile->printer.nozzle;
  if (!options_.port && !chosen_port_) printer["port"] = profile->port;
  add_profile(printer, *profile);
  add_idle(printer);
  return printer;
}

const gcode::Printer* Daemon::profile() const {
  if (current_ && current_->print) return &current_->print->job().profile.printer;
  return own() ? &own()->printer : nullptr;
}

Session& Daemon::session() {
  if (!current_) throw Refused(Why::conflict, "nothing_printed", "nothing is being printed");
  if (current_->reconnecting)
    throw Refused(Why::conflict, "reconnecting",
                  "the printer is not connected; the print goes on when it is back, or can be cancelled");
  if (!current_->print || !current_->print->session())
    throw Refused(Why::conflict, "preparing", "the print is still being prepared");
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

asio::awaitable<std::uint64_t> Daemon::add(std::string name, std::optional<LayerRange> layers,
                                           bool to_print) {
  if (queue_.waiting() >= Queue::most_waiting)
    throw Refused(Why::conflict, "queue_full", "the queue is full");
  if (being_added_->size() >= most_checks)
    throw Refused(Why::conflict, "checking", "other jobs are being checked; queue this one in a moment");
  {
    // The files must not be changed between the check and the queue.
    const auto place = being_added_->insert(name);
    const std::shared_ptr<void> added(nullptr, [all = being_added_, place](void*) { all->erase(place); });
    co_await check(name, layers);
  }
  const std::uint64_t id = queue_.add(std::move(name), layers, to_print);
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
  start_sent();
  sketch_soon();
  co_return id;
}

JobCheck Daemon::check_of(const std::string& name, const std::optional<LayerRange>& layers) const {
  JobCheck check{files_.find(name), options_.profile, layers, {}};
  if (JobFiles::is_upload(name)) check.limits = options_.upload_limits;
  return check;
}

/// Throws Refused for a job that cannot be printed. Jobs in the daemon's own folders are trusted more, and
/// may still get their models; models are read at once, which may take long.
asio::awaitable<void> Daemon::check(std::string name, std::optional<LayerRange> layers) {
  if (JobFiles::is_upload(name) || core::is_model_file(name) || is_sliced_file(name)) {
    const std::string problem = co_await check_in_child(check_of(name, layers), {});
    if (!problem.empty()) throw Refused(Why::bad_job, problem);
    co_return;
  }
  const auto read = [this, name] {
    const std::filesystem::path file = files_.find(name);
    try {
      load_job(file, options_.profile);
    } catch (const core::DataError& error) {
      throw Refused(Why::bad_job, error.what());
    }
    return true;
  };
  co_await elsewhere(disk_, read);
}

asio::awaitable<void> Daemon::remove(std::uint64_t id) {
  if (!queue_.find(id)) throw Refused(Why::not_found, "there is no job with that number");
  if (current_ && current_->id == id)
    throw Refused(Why::conflict, "job_printing", "that job is being printed; cancel it instead");
  QueuedJob removed = *queue_.find(id);
  const std::size_t place = queue_.remove(id);
  std::string problem;
  try {
    co_await save();
  } catch (const core::DataError& error) {
    problem = error.what();
  }
  if (!problem.empty()) {  // it would come back with the next daemon
    queue_.put_back(std::move(removed), place);
    throw Refused(Why::no_room, problem);
  }
  broadcast({{"event", "queue"}, {"removed", id}});
}

asio::awaitable<void> Daemon::enter(std::uint64_t id, QueuedJob::State state, std::string reason) {
  queue_.enter(id, state, reason);
  const QueuedJob* entered = queue_.find(id);
  if (entered) {
    const std::string text =
        fmt::format("job {} {}: {}{}{}", id, entered->name, name(state), reason.empty() ? "" : ": ", reason);
    log_line(text);
    log_record_.note(LogRecord::From::host, text);
  }
  if (entered && last_.contains("job") && last_["job"].value("id", id + 1) == id)
    last_["job"] = to_json(*entered);
  std::string trouble;
  try {
    co_await save();
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  if (!trouble.empty() && problem_.empty()) announce("problem", {}, trouble);
  problem_ = trouble;
  if (const QueuedJob* job = queue_.find(id)) broadcast({{"event", "queue"}, {"job", to_json(*job)}});
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

void Daemon::broadcast_motion(const json& event) {
  std::erase_if(followers_, [](const auto& one) { return !one->open(); });
  const std::string text = text_of(event);
  for (const auto& follower : followers_)
    if (follower->follows_line()) follower->send(text);
}

void Daemon::broadcast_status() {
  broadcast({{"event", "status"}, {"status", status()}});
}

void Daemon::on_session_event(const SessionEvent& event) {
  foretell();
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  if (event.kind == SessionEvent::Kind::heat && session)
    temperature_record_.note(session->status().temperatures);
  if (event.kind == SessionEvent::Kind::progress || event.kind == SessionEvent::Kind::heat)
    return note_progress();
  if (!session) return;
  announce_session(event);
  if (event.kind == SessionEvent::Kind::printer) log_record_.note(LogRecord::From::printer, event.text);
  if (event.kind == SessionEvent::Kind::notice) log_record_.note(LogRecord::From::notice, event.text);
  if (event.kind == SessionEvent::Kind::state) {
    show_soon();  // layers may be planned before the printer reports its heat
    const nlohmann::json status = to_json(session->status());
    const std::string reason = status.value("reason", "");
    const std::string entered = "print: " + status.value("state", "") + (reason.empty() ? "" : ": " + reason);
    log_line(entered);
    log_record_.note(LogRecord::From::host, entered);
  }
  if (followers_.empty()) return;
  SessionEvent shown = event;
  shown.text = event.kind == SessionEvent::Kind::printer ? core::printable(event.text) : event.text;
  broadcast(to_json(shown, session->status()));
}

}  // namespace unicursal::host
