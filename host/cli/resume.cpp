#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/foreground.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/print.hpp"
#include "host/engine/restart.hpp"
#include "host/spool/spool.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

struct ResumeOptions {
  std::optional<std::string> print;  ///< its name or the beginning of it; absent: the newest
  PrintOptions on;
  bool yes = false;   ///< do not ask
  bool list = false;  ///< only list the prints
  DisplayOptions display;
};

fs::path root_of(const ResumeOptions& options) {
  return options.on.spool ? *options.on.spool : default_spool_root();
}

Exit list(const fs::path& root) {
  const std::vector<fs::path> prints = kept_prints(root);
  if (prints.empty()) show(stdout, "no prints are kept in {}\n", root.string());
  for (const fs::path& folder : prints) {
    std::string what;
    try {
      what = describe(folder);
    } catch (const SpoolError& error) {
      what = error.problem();
    }
    show(stdout, "{}: {}\n", folder.filename().string(), what);
  }
  return Exit::success;
}

fs::path chosen_print(const ResumeOptions& options) {
  const fs::path root = root_of(options);
  const std::vector<fs::path> prints = kept_prints(root);
  if (prints.empty()) {
    throw SpoolError(root.string(), "", "there is no print in this folder",
                     "name the folder of the prints with --spool");
  }
  if (!options.print) return prints.front();
  const auto found = [&](const auto& fits) {
    return std::find_if(prints.begin(), prints.end(),
                        [&](const fs::path& folder) { return fits(folder.filename().string()); });
  };
  // A complete name takes precedence, even if other names begin with it.
  auto print = found([&](const std::string& name) { return name == *options.print; });
  if (print == prints.end())
    print = found([&](const std::string& name) { return name.starts_with(*options.print); });
  if (print != prints.end()) return *print;
  throw SpoolError(root.string(), "", "there is no print whose name begins with \"" + *options.print + "\"",
                   "see `unicursal resume --list`");
}

/// Asks at the terminal. Throws SpoolError if there is none; `remedy` is what to do then.
bool wants_to_continue(const char* remedy) {
  if (isatty(STDIN_FILENO) == 0) {
    throw SpoolError("", "", "a person must check the printer, but standard input is not a terminal", remedy);
  }
  show(stdout, "Continue? [y/N] ");
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

/// A later print that may have been on another printer is not a reason to refuse, but only a person knows.
bool agreed(const ResumeOptions& options, const Restart& restart, const std::string& later) {
  const bool sure = restart.highest <= restart.lowest && later.empty();
  if (options.yes && sure) return true;
  if (!later.empty()) {
    show(stdout, "A later print, {}, has begun on another port. Continue only if that was another printer.\n",
         later);
  }
  return wants_to_continue(sure ? "give --yes to confirm it" : "resume at a terminal");
}

ForegroundResult stream_from(Print& print, std::optional<Leg> leg, const ResumeOptions& options) {
  print.connect(std::move(leg));
  return stream_with_progress(print, options.display);
}

Exit end(Print& print, const ForegroundResult& shown, const ResumeOptions& options) {
  const StreamResult& result = shown.stream;
  note_in_history(print, shown);
  show_how_to_resume(print.spool(), result);
  throw_if_failed(result);
  if (result.ending == Ending::completed) show_done(shown, options.display);
  return show_ending(result, options.display);
}

Exit restart(Print& print, const Lost& lost, const ResumeOptions& options) {
  const Restart restart = restart_after(print.production(), print.spool(), lost);
  show(stdout, "{}", restart_in_words(restart, lost, print.spool()));
  if (!agreed(options, restart, check_not_superseded(print.spool(), options.on.port))) {
    show(stdout, "The print was not resumed. If the printer's heaters are on, they stay on: check them.\n");
    return Exit::failed;
  }
  return end(print, stream_from(print, restart.leg, options), options);
}

Exit resume_print(Print& print, const ResumeOptions& options) {
  if (const auto lost = lost_before(print.spool().before())) return restart(print, *lost, options);
  const ForegroundResult shown = stream_from(print, std::nullopt, options);
  const auto& lost = shown.stream.lost;
  return lost ? restart(print, *lost, options) : end(print, shown, options);
}

Exit resume_kept(const ResumeOptions& options) {
  const fs::path folder = chosen_print(options);
  Spool spool = Spool::open(folder);
  const JournalState& before = spool.before();
  if (before.ended && before.ended->outcome == LegOutcome::completed) {
    show(stdout, "{}: this print was completed\n", folder.filename().string());
    return Exit::success;
  }
  check_not_superseded(spool, options.on.port);
  Print print(std::move(spool), options.on);
  return resume_print(print, options);
}

class Resume final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  /// Naming a kept print, or the folder of the prints, means one of those and not the daemon's.
  bool may_concern_daemon() const { return !options_.print && (!options_.on.spool || daemon_.state); }

  Exit resume_of_daemon() const;
  Exit show_job(const nlohmann::json& job) const;

  ResumeOptions options_;
  DaemonAccess daemon_;
};

/// Waits until it is known whether the print goes on; returns its job.
nlohmann::json settled(const Client& client, std::uint64_t id) {
  for (;;) {
    nlohmann::json job = begun_job(client, id);
    const nlohmann::json print =
        accepted(client.ask("GET", "/api/status")).value("print", nlohmann::json::object());
    if (job.value("state", "") != "printing" || print.value("state", "connecting") != "connecting")
      return job;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

/// A paused print goes on at once. An interrupted one is prepared first, and perhaps asks a question.
Exit Resume::resume_of_daemon() const {
  const Client client = daemon_.connect();
  const nlohmann::json status = accepted(client.ask("GET", "/api/status"));
  if (!status.contains("interrupted")) {
    steer(daemon_, "resume");
    return Exit::success;
  }
  const auto id = status["interrupted"].at("id").get<std::uint64_t>();
  accepted(client.ask("POST", "/api/print/resume", nlohmann::json::object()));
  const nlohmann::json job = settled(client, id);
  if (job.value("state", "") != "interrupted") return show_job(job);
  const nlohmann::json asked =
      accepted(client.ask("GET", "/api/status")).value("interrupted", nlohmann::json());
  if (!asked.is_object() || !asked.contains("question")) return show_job(job);
  show(stdout, "{}", asked["question"].get<std::string>());
  if (!options_.yes && !wants_to_continue("give --yes to confirm it")) return Exit::failed;
  accepted(client.ask("POST", "/api/print/resume", {{"sure", true}}));
  return show_job(settled(client, id));
}

Exit Resume::show_job(const nlohmann::json& job) const {
  if (daemon_.json)
    show_json(job);
  else
    show(stdout, "job {}\n", job_text(job));
  const std::string state = job.value("state", "");
  return state == "printing" || state == "done" ? Exit::success : Exit::failed;
}

CLI::App& Resume::declare(CLI::App& program) {
  CLI::App& app =
      add_command(program, "resume", "Print", "Resume an interrupted print, or the daemon's paused print.",
                  "unicursal resume");
  add_note(
      app,
      "If a daemon (`unicursal serve`) has a paused or an interrupted print, that is resumed. Otherwise an "
      "interrupted print "
      "is resumed. If the printer is still on and hot, the print continues with the next line: no line "
      "is lost or run twice. If the printer was reset or has cooled, the program reports where the print "
      "stopped and asks. Then the nozzle heats where it stands, rises, homes x and y, purges plastic "
      "beside the part, and continues at the last place that is certain. z cannot be homed on a part, so "
      "the z axis must not have been moved. The start lines of the profile are not run again.");
  add_value(app, "PRINT", options_.print, " ",
            "The print to resume: its name or the beginning of it. Default: the newest print.");
  app.add_flag("--list", options_.list, "List the prints that are kept, and do nothing else.");
  app.add_flag("--yes", options_.yes, "Do not ask before continuing after a reset or a power cut.");
  declare_port(app, options_.on.port, "the port on which the print began");
  declare_pause_heat(app, options_.on.pause_heat);
  declare_spool(app, options_.on.spool);
  daemon_.declare_place(app);
  declare_events(app, options_.display);
  declare_quiet(app, options_.display.quiet);
  declare_log(app, options_.on.log);
  add_steering_note(app);
  return app;
}

Exit Resume::run() {
  if (options_.list) return list(root_of(options_));
  daemon_.json = options_.display.json;
  if (may_concern_daemon() && (daemon_.remote() || daemon_.has_print())) return resume_of_daemon();
  return resume_kept(options_);
}

}  // namespace

std::unique_ptr<Command> make_resume() {
  return std::make_unique<Resume>();
}

}  // namespace unicursal::host
