// The daemon's state: a queue of jobs, at most one print, and the followers of its events. It knows nothing
// of HTTP (api.hpp) or signals (serve.hpp). Everything belongs to the loop's thread; files are read and
// written, and prints prepared, in threads of their own.
//
// No print starts by itself: somebody has to take the last part off the bed first. With `start_uploads`, a
// file that a slicer sends to be printed starts once somebody has confirmed that, and nothing has been
// printed since.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "host/daemon/dry_runs.hpp"
#include "host/daemon/event_command.hpp"
#include "host/daemon/interrupted.hpp"
#include "host/daemon/job_check.hpp"
#include "host/daemon/job_files.hpp"
#include "host/daemon/log_record.hpp"
#include "host/daemon/past_prints.hpp"
#include "host/daemon/queue.hpp"
#include "host/daemon/temperature_record.hpp"
#include "host/doctor/reported_profile.hpp"
#include "host/engine/print.hpp"
#include "host/history/keep.hpp"
#include "host/idle/idle_printer.hpp"
#include "host/live/live_line.hpp"

namespace unicursal::host {

struct DaemonOptions {
  std::filesystem::path state;                   ///< folder (state_folder.hpp)
  std::vector<std::filesystem::path> jobs;       ///< folders of jobs
  std::optional<std::string> port;               ///< absent: the profile's
  std::optional<std::filesystem::path> profile;  ///< of the printer, instead of the jobs' own
  std::optional<std::filesystem::path> spool;    ///< folder of the prints
  PauseHeat pause_heat = PauseHeat::keep;
  std::optional<std::string> on_event;  ///< a command that hears of prints (event_command.hpp)
  bool start_uploads = false;  ///< those that are sent to be printed, once the bed is confirmed clear
  CheckLimits upload_limits{1024 * 1024 * 1024,
                            std::chrono::seconds(20)};  ///< for uploads, when they are queued
};

/// Somebody who follows the daemon's events.
class Follower {
 public:
  virtual ~Follower() = default;
  /// False once its client has gone; the daemon then drops it.
  virtual bool open() const = 0;
  /// `event`: JSON, as in API.md.
  virtual void send(const std::string& event) = 0;
  /// Whether it wants to hear where the nozzle is and how layers grow.
  virtual bool follows_line() const { return true; }
};

class Daemon {
 public:
  /// Throws core::DataError for an unreadable profile, a missing folder, or a damaged queue.
  Daemon(asio::io_context& loop, const DaemonOptions& options);
  ~Daemon();

  nlohmann::json status() const;
  nlohmann::json printer() const;
  /// Of the current print, or of the daemon; null if none is known.
  const gcode::Printer* profile() const;
  const Queue& queue() const { return queue_; }
  const JobFiles& files() const { return files_; }
  PastPrints& past_prints() { return past_prints_; }
  /// The line of the current print. Throws Refused when there is none.
  LiveLine& live();
  asio::awaitable<std::optional<PathPiece>> path_of(std::uint64_t layer, std::uint64_t from);
  /// Where the nozzle is; empty while that is not known. Throws Refused when nothing is being printed.
  nlohmann::json position();
  TemperatureRecord& temperature_record() { return temperature_record_; }
  LogRecord& log_record() { return log_record_; }

  DryRuns& dry_runs() { return dry_runs_; }
  /// Begins a dry run of a job, which is checked as by add(), and returns its number. Throws Refused, also
  /// while a print has hardly anything planned ahead.
  asio::awaitable<std::uint64_t> try_job(std::string name, std::optional<LayerRange> layers);

  /// The session of the current print. Throws Refused when there is none.
  Session& session();
  /// Checks the job's text, adds the job to the queue, and returns its number. The models of an upload are
  /// read and planned for a try as well, in a child process with limits. Throws Refused.
  /// `to_print`: it was sent to be printed at once, and may be started as `start_uploads` says.
  asio::awaitable<std::uint64_t> add(std::string name, std::optional<LayerRange> layers,
                                     bool to_print = false);
  /// Queues the job of a past print. Throws Refused, also if its file is gone.
  asio::awaitable<std::uint64_t> print_again(PastPrint print);
  /// Queues the same job once more. Throws Refused.
  asio::awaitable<std::uint64_t> copy(std::uint64_t id);
  /// The waiting jobs are printed in this order, and those that it does not name afterwards. Throws Refused,
  /// also if one of these does not wait.
  asio::awaitable<void> arrange(std::vector<std::uint64_t> ids);
  /// A small picture of a job, PNG. Throws Refused while there is none yet, or if none can be made.
  asio::awaitable<std::string> job_picture(std::uint64_t id);
  /// What continuing a kept print will do, sentences; nothing is done yet. Throws Refused.
  asio::awaitable<std::string> would_resume(std::string name);
  /// Continues it, as continue_interrupted() does. Returns its job's number at once. Throws Refused.
  asio::awaitable<std::uint64_t> resume_kept(std::string name);
  /// Removes a job from the queue. Throws Refused, also for the one that is being printed.
  asio::awaitable<void> remove(std::uint64_t id);
  /// A file that arrives piece by piece: room for it, a piece of it, and the whole, which gets a name of its
  /// own (JobFiles::adopt()) and is not queued yet; returns the job's name. Throw Refused.
  asio::awaitable<std::shared_ptr<UploadDraft>> draft_upload(std::uint64_t bytes);
  asio::awaitable<void> write_upload(std::shared_ptr<UploadDraft> draft, std::string bytes);
  asio::awaitable<std::string> adopt_upload(std::shared_ptr<UploadDraft> draft, std::string file);
  asio::awaitable<std::vector<LocalFile>> local_files();
  asio::awaitable<LocalFile> local_file(std::string name);
  /// Throws Refused, also while a job of this upload waits or is printed: a job is checked only once.
  asio::awaitable<void> keep_upload(std::string upload, std::string file, std::string bytes);
  asio::awaitable<void> remove_upload(std::string upload);
  asio::awaitable<std::vector<std::string>> job_names();
  /// Prepares and then prints a job, the first that waits if `id` is absent. Returns its number at once. A
  /// job whose printer is off stays in the queue, or returns to it with a reason. Throws Refused, also while
  /// an interrupted print may stand on the bed, unless somebody says that the bed is clear.
  std::uint64_t start(std::optional<std::uint64_t> id, bool bed_clear = false);
  /// Continues the interrupted print. If its printer has lost its place, the status asks a question; `sure`
  /// answers it. Returns the job's number at once. Throws Refused.
  std::uint64_t continue_interrupted(bool sure);
  /// Somebody has seen that the bed is clear. An upload that was sent to be printed then starts, if
  /// `start_uploads` says so. Throws Refused during a print.
  void confirm_bed_clear();
  /// Whether the printer's port is there; an "auto" one always is.
  bool port_exists() const;
  /// Cancels the print, also while it is being prepared. Throws Refused when there is none.
  void cancel(const std::string& reason);
  void stop_at_once();

  /// The printer while nothing is printed (idling.cpp). Throws Refused, for example while a print goes on.
  IdlePrinter& idle();
  /// Opens the port; `named`: another one than the daemon's. Throws Refused.
  void connect_printer(const std::string& named);
  /// Switches off what is hot, and closes the port. Throws Refused during a print.
  void disconnect_printer();

  /// Asks what hangs on a port; `named`: another one than the daemon's. Throws Refused.
  asio::awaitable<FoundPrinter> examine_printer(std::string named);
  asio::awaitable<std::vector<PortInfo>> ports();
  /// Of the printer: the daemon's, or else the user's; null if there is none.
  const Profile* whole_profile() const { return own(); }
  struct ProfileAsText {
    std::filesystem::path file;
    std::string text;
  };
  /// Throws Refused if there is none, core::FileError.
  asio::awaitable<ProfileAsText> profile_text();
  /// Writes it, and uses it from now on. Throws Refused during a print, JobError, core::FileError.
  asio::awaitable<void> keep_profile(std::filesystem::path file, std::string text);
  /// Where a new one goes. Throws Refused, also if it exists and is not to be replaced.
  std::filesystem::path new_profile_file(bool replace) const;

  /// Sends it the present status, and every event from now on.
  void join(std::unique_ptr<Follower> follower);
  /// No further print begins; the current one is parked and cooled, or stopped at once by a second call.
  /// `done` is called when no print is left.
  void shut_down(std::function<void()> done);
  bool busy() const { return current_.has_value(); }
  /// Whether a print is going on that is to be parked and cooled before the daemon ends.
  bool printing() const { return in_session() || idle_.feeding(); }
  /// The name of the print that is going on, as it is kept; empty: there is none.
  std::string printing_as() const;

 private:
  static constexpr std::size_t most_checks = 2;  ///< of jobs at once: each may take a core and much memory

  /// Whether a print has its session, so that current_->print->session() is there.
  bool in_session() const { return current_ && current_->print && current_->print->session(); }

  struct Current {
    std::uint64_t id = 0;
    std::shared_ptr<LiveLine> live;        ///< null until the first session; outlives all of them
    std::unique_ptr<Print> print;          ///< null until it is prepared
    std::optional<std::string> cancelled;  ///< the reason, if it was cancelled before that
    std::stop_source preparing;            ///< ends the preparation, and the waiting for a printer
    bool reconnecting = false;   ///< the cable was pulled; the print goes on when the printer is back
    bool begun = false;          ///< lines of it may have been sent
    nlohmann::json last_status;  ///< of its last session, or null
    EndedSession outcome;        ///< for the history
    bool sent = false;           ///< a session has had its printer
    bool took_over = false;      ///< the idle connection's open port
    bool announced = false;      ///< the user's command has heard of it
    bool paused = false;         ///< and of the present pause
    std::string asked;           ///< the printer's question that the command has heard of
    std::optional<std::chrono::steady_clock::time_point> started;  ///< its first session
  };
  /// How an interrupted print is continued.
  struct Continuing {
    Interrupted print;
    bool sure = false;
  };

  void begin(std::uint64_t id, std::optional<Continuing> continuing);
  asio::awaitable<void> print(std::uint64_t id, std::optional<Continuing> continuing);
  asio::awaitable<std::string> print_new(std::uint64_t id, QueuedJob::State& ending);
  asio::awaitable<std::string> continue_print(std::uint64_t id, Continuing how, QueuedJob::State& ending);
  asio::awaitable<StreamResult> run_sessions(std::uint64_t id);
  asio::awaitable<StreamResult> run_session(std::uint64_t id);
  std::string conclude(const StreamResult& result, QueuedJob::State& ending);
  void note_history(const std::string& trouble);
  void foretell();
  void announce(const std::string& event, const std::string& state, const std::string& reason);
  void announce_session(const SessionEvent& event);
  void sketch_soon();
  asio::awaitable<void> sketch_waiting();
  bool may_sketch() const;
  const QueuedJob* next_to_sketch() const;
  asio::awaitable<nlohmann::json> sketch(QueuedJob job);
  void check_may_begin() const;
  void end_print();
  void remember(std::uint64_t id, QueuedJob::State ending);
  PrintOptions print_options(const std::string& job) const;
  void broadcast_status();
  asio::awaitable<std::unique_ptr<Print>> prepare_print(const QueuedJob& job, std::stop_token stop);
  std::unique_ptr<Print> prepared(const QueuedJob& job, const PrintOptions& options) const;
  void note_begun(const QueuedJob& job, Print& print) const;
  JobCheck check_of(const std::string& name, const std::optional<LayerRange>& layers) const;
  asio::awaitable<void> check(std::string name, std::optional<LayerRange> layers);
  void check_not_needed(const std::string& upload) const;
  std::set<std::string> needed_uploads() const;
  void start_sent();
  std::string port() const;
  void check_port_exists() const;
  std::string way_on() const;
  asio::awaitable<void> save();
  asio::awaitable<void> enter(std::uint64_t id, QueuedJob::State state, std::string reason);
  asio::awaitable<FoundPrinter> examine_at(const std::string& port, unsigned baud, int& descriptor);
  void check_idle() const;
  void check_not_at_work() const;
  void check_nothing_interrupted() const;
  std::string checked_port(const std::string& named) const;
  std::optional<std::filesystem::path> profile_file() const;
  void load_own_profile();
  const Profile* own() const;
  asio::awaitable<void> connect_print(Print& print, std::optional<Leg> leg = {});
  void take_printer_back();
  void let_printer_go(bool again);
  void watch_idle_printer();
  void show_idle_soon();
  void add_idle(nlohmann::json& printer) const;
  static nlohmann::json idle_heat(const gcode::Temperatures& known);
  static void add_profile(nlohmann::json& printer, const Profile& profile);
  void on_session_event(const SessionEvent& event);
  void broadcast(const nlohmann::json& event);
  void broadcast_motion(const nlohmann::json& event);
  // What is shown of the line (watching.cpp)
  void follow_line();
  std::optional<LiveNozzle> nozzle();
  void note_progress();
  void show_soon();
  void show();
  std::map<std::size_t, KnownLayer>::iterator next_changed_layer();
  nlohmann::json job_and_print() const;

  asio::io_context& loop_;
  const DaemonOptions options_;
  std::optional<Profile> profile_;
  std::optional<Profile> own_profile_;      ///< of the user, if the daemon was given none
  std::optional<std::string> chosen_port_;  ///< by a client, if the daemon was given none
  JobFiles files_;
  Queue queue_;
  /// Names of jobs that are being checked; shared with the checks, which a stopped loop ends later than this.
  std::shared_ptr<std::multiset<std::string>> being_added_ = std::make_shared<std::multiset<std::string>>();
  std::optional<Current> current_;
  std::optional<Interrupted> interrupted_;
  bool bed_clear_ = false;       ///< somebody has confirmed it, and no print has begun since
  nlohmann::json last_;          ///< the final status of the last print, or null
  std::string firmware_;         ///< the printer's last answer to M115
  std::string problem_;          ///< with the state folder, a sentence; empty: none
  std::string history_problem_;  ///< when the last print was added to the history; as above
  std::function<void()> when_idle_;
  std::vector<std::unique_ptr<Follower>> followers_;
  PastPrints past_prints_;
  std::optional<EventCommand> event_command_;
  std::set<std::uint64_t> not_sketched_;  ///< jobs of which no picture can be made
  bool sketching_ = false;
  asio::steady_timer sketch_timer_;
  std::stop_source sketch_stop_;  ///< of the child that makes one
  TemperatureRecord temperature_record_;
  LogRecord log_record_;
  DryRuns dry_runs_;
  asio::steady_timer progress_;
  bool progress_waits_ = false;  ///< the timer runs
  bool progress_due_ = false;
  std::chrono::steady_clock::time_point shown_progress_{}, shown_layer_{};
  std::map<std::size_t, KnownLayer> changed_layers_;  ///< that nobody was shown yet
  std::size_t next_layer_number_ = 0;                 ///< whose turn it is to be shown
  nlohmann::json shown_position_;
  asio::thread_pool disk_{1}, preparing_{1};
  asio::thread_pool looking_{1};  ///< at how kept prints would go on; it may take as long as a preparation
  asio::thread_pool opening_{1};  ///< where the idle printer's port is opened
  IdlePrinter idle_;
  /// A printer that was lost with its heaters on, by a print that was stopped.
  struct LeftHot {
    Profile profile;
    std::string port;
  };
  std::optional<LeftHot> left_hot_;
  bool idle_returns_ = false;  ///< the idle connection comes back after the print
  /// Doctor has the port; shared with the examination, which a stopped loop ends later than this.
  std::shared_ptr<bool> examining_ = std::make_shared<bool>(false);
  unsigned idle_baud_ = 0;    ///< of the idle connection's port; 0: it was never opened
  std::string idle_note_;     ///< why the connection has not come back, a sentence
  std::string idle_problem_;  ///< the last one that was logged
  asio::steady_timer idle_shown_;
  asio::steady_timer::time_point idle_next_{};  ///< of the next event of the idle printer
  bool idle_waits_ = false;
  asio::thread_pool ending_{1};  ///< where prints go away, so that the next one is prepared meanwhile
};

}  // namespace unicursal::host
