// How a daemon prints: from a queued job, or an interrupted print, to cold heaters.
#include <fmt/format.h>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/post.hpp>
#include <utility>

#include "core/stopping.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/service_notify.hpp"
#include "host/engine/produce.hpp"
#include "host/engine/reconnecting.hpp"
#include "host/engine/restart.hpp"
#include "host/engine/seconds.hpp"
#include "host/engine/session_json.hpp"
#include "host/history/keep.hpp"
#include "host/job/load_job.hpp"
#include "host/loop/sentence.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

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

std::uint64_t Daemon::start(std::optional<std::uint64_t> id, bool bed_clear) {
  if (when_idle_) throw Refused(Why::conflict, "ending", "the daemon is ending");
  if (current_) throw Refused(Why::printing, "a print is going on");
  check_not_at_work();
  const QueuedJob* job = id ? queue_.find(*id) : queue_.next();
  if (!job)
    throw id ? Refused(Why::not_found, "there is no job with that number")
             : Refused(Why::conflict, "nothing_waits", "no job is waiting");
  // Somebody may have continued it beside this daemon.
  if (interrupted_ && !interrupted_print(options_.state)) interrupted_.reset();
  if (interrupted_ && !bed_clear && !bed_clear_) {
    throw Refused(
        Why::conflict, "interrupted",
        "the print of job " + std::to_string(interrupted_->id) +
            " was interrupted, and its printer may be hot with its nozzle in the part; continue it with "
            "`unicursal resume`, or clear the bed and start with --bed-clear");
  }
  check_port_exists();
  interrupted_.reset();
  const std::uint64_t chosen = job->id;
  begin(chosen, std::nullopt);
  return chosen;
}

std::uint64_t Daemon::continue_interrupted(bool sure) {
  if (when_idle_) throw Refused(Why::conflict, "ending", "the daemon is ending");
  if (current_) throw Refused(Why::printing, "a print is going on");
  check_not_at_work();
  if (interrupted_ && !interrupted_print(options_.state)) interrupted_.reset();
  if (!interrupted_)
    throw Refused(Why::conflict, "nothing_printed", "nothing is being printed, and no print was interrupted");
  if (sure && interrupted_->question.empty())
    throw Refused(Why::conflict, "nothing was asked; continue the print, and it is asked if need be");
  check_port_exists();
  Continuing how{*interrupted_, sure};
  if (!queue_.find(how.print.id)) how.print.id = queue_.add(how.print.job, std::nullopt);
  const std::uint64_t id = how.print.id;
  begin(id, std::move(how));
  return id;
}

void Daemon::begin(std::uint64_t id, std::optional<Continuing> continuing) {
  bed_clear_ = false;
  sketch_stop_.request_stop();
  current_.emplace();
  current_->id = id;
  queue_.enter(id, QueuedJob::State::preparing);
  asio::co_spawn(
      loop_,
      [this, id, continuing = std::move(continuing)]() -> asio::awaitable<void> {
        co_await print(id, continuing);
      },
      asio::detached);
}

std::string Daemon::printing_as() const {
  return current_ && current_->print && current_->print->has_spool() ? current_->print->kept_as() : "";
}

std::string Daemon::port() const {
  if (options_.port) return *options_.port;
  return chosen_port_ ? *chosen_port_ : profile_ ? profile_->port : "";
}

bool Daemon::port_exists() const {
  std::error_code error;
  return !port().starts_with('/') || std::filesystem::exists(port(), error);
}

/// Throws Refused if the printer's port is a device that is not there; then the job has not left the queue.
void Daemon::check_port_exists() const {
  if (!port_exists())
    throw Refused(Why::absent,
                  "the printer's port " + core::printable(port()) +
                      " is not there: plug the printer in and switch it on; the job stays in the queue");
}

void Daemon::confirm_bed_clear() {
  if (current_) throw Refused(Why::printing, "a print is going on; confirm it when the part was taken off");
  bed_clear_ = true;
  broadcast_status();
  start_sent();
}

/// Starts the first upload that was sent to be printed, if the user wants that and the bed is known to be
/// clear.
void Daemon::start_sent() {
  if (!options_.start_uploads || !bed_clear_ || current_ || when_idle_) return;
  const QueuedJob* job = queue_.next_to_print();
  if (!job) return;
  try {
    log_line(
        fmt::format("job {} {}: starts by itself, since the bed was confirmed clear", job->id, job->name));
    start(job->id, true);
  } catch (const Refused& refused) {
    log_line(fmt::format("it waits: {}", refused.what()));
  }
}

PrintOptions Daemon::print_options(const std::string& job) const {
  PrintOptions options;
  options.port = options_.port ? options_.port : chosen_port_;
  if (!options.port && profile_) options.port = profile_->port;
  if (!options.port && JobFiles::is_upload(job)) options.port = "auto";  // an upload may name any port
  options.spool = options_.spool;
  options.pause_heat = options_.pause_heat;
  return options;
}

/// Reads files; blocks. In another thread: what clients may change meanwhile is in `options`.
std::unique_ptr<Print> Daemon::prepared(const QueuedJob& job, const PrintOptions& options) const {
  return std::make_unique<Print>(
      produce(load_job_or_model(files_.find(job.name), options_.profile, UnnamedPrinter::refuse), job.layers),
      options);
}

/// A job is read by a child process first: a preparation that does not end can be cancelled there at once,
/// wherever it is, and files that have changed since the job was queued harm only the child. Throws
/// core::Stopped.
asio::awaitable<std::unique_ptr<Print>> Daemon::prepare_print(const QueuedJob& job, std::stop_token stop) {
  const std::string problem = co_await check_in_child(check_of(job.name, job.layers), stop);
  if (!problem.empty()) throw core::DataError("", "", problem, "");
  const auto prepare = [this, job, stop, options = print_options(job.name)] {
    const core::StopScope scope(stop);
    core::stop_point();
    return prepared(job, options);
  };
  std::unique_ptr<Print> print = co_await elsewhere(preparing_, prepare);
  std::exception_ptr error;
  try {
    co_await connect_print(*print);
    const auto note = [&] { return note_begun(job, *print), true; };
    co_await elsewhere(preparing_, note);
  } catch (...) {
    error = std::current_exception();
  }
  if (!error) co_return print;
  print->end();
  asio::post(ending_, [gone = std::shared_ptr<Print>(std::move(print))]() mutable { gone.reset(); });
  std::rethrow_exception(error);
}

void Daemon::note_begun(const QueuedJob& job, Print& print) const {
  try {
    note_printing(options_.state, {job.id, job.name, print.spool().folder(), {}});
  } catch (...) {
    print.spool().discard();
    throw;
  }
}

asio::awaitable<void> Daemon::print(std::uint64_t id, std::optional<Continuing> continuing) {
  auto ending = QueuedJob::State::failed;
  const auto not_begun = continuing ? QueuedJob::State::interrupted : QueuedJob::State::queued;
  std::string reason;
  std::exception_ptr error;
  try {
    if (continuing)
      reason = co_await continue_print(id, *continuing, ending);
    else
      reason = co_await print_new(id, ending);
  } catch (const PortError& closed) {
    ending = not_begun;
    reason = closed.what();
  } catch (const core::Stopped&) {
    ending = continuing ? QueuedJob::State::interrupted : QueuedJob::State::stopped;
    reason = current_->cancelled.value_or("the daemon was asked to end");
  } catch (...) {
    error = std::current_exception();
  }
  if (error) reason = current_->outcome.reason = sentence(error);
  if (error && continuing) ending = QueuedJob::State::interrupted;
  if (continuing && !interrupted_) interrupted_ = continuing->print;
  remember(id, ending);
  if (current_->announced) announce("print_ended", host::name(ending), current_->outcome.reason);
  if (current_->print) {
    last_ = current_->print->session() || !current_->last_status.is_null() ? job_and_print() : json();
    end_print();
  }
  current_.reset();
  notify_service("STATUS=idle");
  take_printer_back();
  co_await enter(id, ending, reason);
  if (when_idle_) {
    const auto away = [] { return true; };
    co_await elsewhere(ending_, away);  // the print is in the history before the daemon ends
    co_await past_prints_.settled();
    let_printer_go(false);
  }
  sketch_soon();
}

/// The print goes away in a thread of its own, and into the history there.
void Daemon::end_print() {
  EndedSession outcome = std::move(current_->outcome);
  outcome.job = queue_.find(current_->id)->name;
  if (current_->started) outcome.seconds = seconds(std::chrono::steady_clock::now() - *current_->started);
  current_->print->end();
  // A session that has found its printer lost has sent nothing.
  const bool sent = current_->sent;
  asio::post(ending_, [this, gone = std::shared_ptr<Print>(std::move(current_->print)),
                       outcome = std::move(outcome), sent]() mutable {
    try {
      auto entry = sent ? history_entry(gone->spool(), gone->production(), outcome) : std::nullopt;
      gone.reset();  // somebody may continue it
      if (entry) past_prints_.keep(std::move(*entry));
    } catch (const std::exception& error) {
      log_line(std::string("the print could not be added to the history: ") + error.what());
    }
  });
}

/// The first forecast of the print's time is kept.
void Daemon::foretell() {
  if (!current_ || current_->outcome.foretold || !current_->print || !current_->print->session()) return;
  const SessionStatus status = current_->print->session()->status();
  if (status.left) current_->outcome.foretold = status.elapsed + *status.left;
}

/// Whether the print that has ended may still be continued, and must not be printed over.
void Daemon::remember(std::uint64_t id, QueuedJob::State ending) {
  if (ending == QueuedJob::State::interrupted) return;  // it stays what it was
  if (ending == QueuedJob::State::failed && current_->begun) {
    interrupted_ = Interrupted{id, queue_.find(id)->name, current_->print->spool().folder(), {}};
    return;
  }
  interrupted_.reset();
  forget_printing(options_.state);
}

/// Returns why the print did not complete; empty if it did.
asio::awaitable<std::string> Daemon::print_new(std::uint64_t id, QueuedJob::State& ending) {
  co_await enter(id, QueuedJob::State::preparing, {});
  const QueuedJob job = *queue_.find(id);
  current_->print = co_await prepare_print(job, current_->preparing.get_token());
  if (current_->cancelled) {
    current_->print->spool().discard();  // nothing was sent
    throw core::Stopped();
  }
  co_return conclude(co_await run_sessions(id), ending);
}

/// Goes on with the next line if the printer is where the print left it. Otherwise a person has to agree to
/// what will be done: the first call asks, and the second one, which is sure, does it.
asio::awaitable<std::string> Daemon::continue_print(std::uint64_t id, Continuing how,
                                                    QueuedJob::State& ending) {
  ending = QueuedJob::State::interrupted;
  co_await enter(id, QueuedJob::State::preparing, {});
  std::string later;
  const auto open = [&how, &later, stop = current_->preparing.get_token(),
                     options = print_options(how.print.job)] {
    const core::StopScope scope(stop);
    Spool spool = Spool::open(how.print.folder);
    later = check_not_superseded(spool, options.port);
    return std::make_unique<Print>(std::move(spool), options);
  };
  const auto away = [] { return true; };
  co_await elsewhere(ending_, away);   // this print may have ended a moment ago
  co_await elsewhere(looking_, away);  // a look at it holds its folder
  current_->print = co_await elsewhere(preparing_, open);
  Print& print = *current_->print;
  if (current_->cancelled) throw core::Stopped();
  std::optional<Lost> lost = lost_before(print.spool().before());
  if (!lost && (idle_.wanted() || idle_.may_be_hot()))
    lost = Lost{"the printer has been used since", std::nullopt};
  if (!lost && later.empty()) {
    co_await connect_print(print);
    const StreamResult result = co_await run_sessions(id);
    if (!result.lost) co_return conclude(result, ending);
    lost = result.lost;
    print.end();
  }
  if (!lost) lost = Lost{"only a person knows whether it was left alone", std::nullopt};
  const auto plan = [&print, &lost] { return restart_after(print.production(), print.spool(), *lost); };
  const Restart restart = co_await elsewhere(preparing_, plan);
  std::string question = restart_in_words(restart, *lost, print.spool());
  if (!later.empty())
    question += "A later print, " + later +
                ", has begun on another port. Continue only if that was another printer.\n";
  if (!how.sure) {
    interrupted_ = how.print;
    interrupted_->question = std::move(question);
    co_return "a person has to agree to how it continues: see `unicursal resume`";
  }
  co_await connect_print(print, restart.leg);
  co_return conclude(co_await run_sessions(id), ending);
}

/// One session, and further ones while the cable is pulled and plugged in again.
asio::awaitable<StreamResult> Daemon::run_sessions(std::uint64_t id) {
  StreamResult result = co_await run_session(id);
  const auto stopped = [&] { return result.stop != StopAsked::no || current_->cancelled || when_idle_; };
  while (may_reconnect(result) && !stopped()) {
    log_line(fmt::format("job {}: {}; waiting for the printer to come back", id, result.reason));
    current_->last_status = to_json(current_->print->session()->status());
    current_->print->end();
    current_->reconnecting = true;
    broadcast_status();
    announce("problem", "reconnecting", result.reason);
    std::string problem;
    bool back = false;
    try {
      back = co_await reconnect(*current_->print, preparing_.get_executor(), current_->preparing.get_token());
    } catch (const core::DataError& error) {
      problem = error.what();
    }
    current_->reconnecting = false;
    if (!back) {
      result.reason += problem.empty() ? "; the printer did not come back" : "; " + problem;
      break;
    }
    log_line(fmt::format("job {}: the printer is back", id));
    result = as_failure(co_await run_session(id));
  }
  // One that is cancelled only now may be continued by its name, with what is still hot.
  if (may_reconnect(result) && (result.stop != StopAsked::no || when_idle_))
    left_hot_ = LeftHot{current_->print->job().profile, current_->print->port_when_back()};
  co_return result;
}

asio::awaitable<StreamResult> Daemon::run_session(std::uint64_t id) {
  if (!current_->started) current_->started = std::chrono::steady_clock::now();
  follow_line();
  Session& session = current_->print->begin(loop_.get_executor());
  session.on_event([this](const SessionEvent& event) { on_session_event(event); });
  // It was cancelled while the printer was being found again: the session still parks and cools it.
  if (current_->cancelled) session.cancel(*current_->cancelled);
  co_await enter(id, QueuedJob::State::printing, {});
  notify_service("STATUS=printing " + core::printable(queue_.find(id)->name));
  const StreamResult result = co_await session.run();
  firmware_ = result.firmware;
  if (current_->took_over && result.begun && !result.lost && result.statistics.lines > 0)
    idle_.leave_heat_to_print();
  current_->sent = current_->sent || !result.lost;
  current_->begun = current_->begun || result.begun;
  co_return result;
}

/// Returns why the print did not complete; empty if it did.
std::string Daemon::conclude(const StreamResult& result, QueuedJob::State& ending) {
  ending = state_after(result.ending);
  // A printer that is switched off, or does not answer, is not the job's fault.
  if (result.ending == Ending::failed && !current_->begun && !result.unfit) ending = QueuedJob::State::queued;
  const Session* session = current_->print->session();
  std::string reason = result.ending == Ending::stopped && session ? session->status().reason : result.reason;
  current_->outcome.reason = reason;
  if (session) current_->outcome.warnings = session->status().warnings;
  if (result.ending != Ending::completed && current_->begun)
    reason += "; to continue it: " + way_on() + " " + current_->print->kept_as();
  return reason;
}

/// The command that continues a print; a terminal may have another folder of prints.
std::string Daemon::way_on() const {
  return options_.spool ? "unicursal resume --spool " + options_.spool->string() : "unicursal resume";
}

void Daemon::cancel(const std::string& reason) {
  if (!current_) throw Refused(Why::conflict, "nothing_printed", "nothing is being printed");
  if (!current_->print || !current_->print->session()) {
    current_->cancelled = reason;
    current_->preparing.request_stop();
    return;
  }
  if (const Refusal no = session().cancel(reason)) throw Refused(Why::conflict, *no);
}

void Daemon::stop_at_once() {
  // Also while a print is being prepared: until then the printer may still be moving and hot.
  if (!in_session() && idle_.status().connection == IdleStatus::Connection::open) {
    if (current_) cancel("the user has stopped it");
    return idle_.stop_at_once();
  }
  if (!current_) throw Refused(Why::conflict, "nothing_printed", "nothing is being printed");
  if (!current_->print || !current_->print->session()) return cancel("the user has stopped it");
  if (const Refusal no = session().emergency_stop()) throw Refused(Why::conflict, *no);
}

void Daemon::shut_down(std::function<void()> done) {
  const bool again = static_cast<bool>(when_idle_);
  when_idle_ = std::move(done);
  if (!current_) return let_printer_go(again);
  try {
    if (again)
      stop_at_once();
    else
      cancel("the daemon was asked to end");
  } catch (const Refused&) {
    // The print is ending already.
  }
}

}  // namespace unicursal::host
