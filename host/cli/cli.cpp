#include "host/cli/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <limits>

#include "core/error.hpp"
#include "core/text/printable.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/cli/version.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/session_types.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {
namespace {

/// The options of every command, and which one was given.
class CommandLine {
 public:
  CommandLine() {
    app_.set_version_flag("--version", std::string("unicursal ") + version);
    app_.require_subcommand(1);
    app_.footer(
        "unicursal COMMAND --help tells more about a command, with an example.\nExit codes: 0 success, 1 it "
        "did not end well, 2 the input was refused, 3 stopped by the user.");
    declare_dry_run();
    declare_plan();
    declare_print();
    declare_resume();
    declare_curve();
    declare_simulate();
    declare_doctor();
    declare_tune();
    declare_serve();
    declare_remote();
    command("ports", "list the serial ports that a printer may hang on", "unicursal ports");
  }

  Exit run(int argc, char** argv) {
    check_command(argc, argv);
    app_.parse(argc, argv);
    const std::string name = app_.get_subcommands().front()->get_name();
    if (name == "dry-run") return dry_run(dry_run_command());
    if (name == "plan") return plan({job_.options(), output_});
    if (name == "print") {
      return print({job_.options(), text_if(port_), path_if(spool_), path_if(log_), {json_}, pause_heat()});
    }
    if (name == "serve") return serve(serve_options());
    if (name == "queue") return queue(queue_command());
    if (name == "set") return set({remote_command(name), set_.speed, set_.flow, set_.nozzle, set_.bed});
    if (name == "status" || name == "start" || name == "pause" || name == "cancel" || name == "stop") {
      return remote(remote_command(name));
    }
    if (name == "resume" && means_daemon() && daemon_prints(remote_command(name))) {
      return remote(remote_command(name));
    }
    if (name == "resume") {
      return resume({text_if(print_),
                     path_if(spool_),
                     text_if(port_),
                     path_if(log_),
                     yes_,
                     list_,
                     {json_},
                     pause_heat()});
    }
    if (name == "doctor") return doctor(doctor_command());
    if (name == "curve") return curve(curve_command());
    if (name == "simulate") return simulate(simulate_command());
    if (name == "tune") return tune(tune_.finished());
    return ports();
  }

  int exit(const CLI::ParseError& error) {
    // --help and --version come as errors of code 0.
    if (error.get_exit_code() == 0) return app_.exit(error);
    show(stderr, "unicursal: {}; unicursal --help lists what there is\n", error.what());
    return static_cast<int>(Exit::bad_input);
  }

 private:
  /// CLI11 would only say that a command is missing.
  void check_command(int argc, char** argv) const {
    if (argc < 2 || argv[1][0] == '-') return;
    for (const CLI::App* known : app_.get_subcommands({})) {
      if (known->check_name(argv[1])) return;
    }
    throw core::DataError("", "", "there is no command \"" + core::printable(argv[1]) + "\"",
                          "unicursal --help lists what there is");
  }

  CLI::App* command(const std::string& name, const std::string& what, const std::string& example) {
    CLI::App* app = app_.add_subcommand(name, what);
    app->footer("Example:\n  " + example);
    return app;
  }

  void declare_dry_run() {
    CLI::App* app = command("dry-run", "print on a simulated printer, and see what would come out",
                            "unicursal dry-run heart.toml --report heart.json --picture pictures");
    job_.declare(*app);
    job_.declare_full_quality(*app);
    declare_json(*app);
    app->add_option(
           "--speed", speed_,
           "printer seconds per second; 0, the default, is virtual time: as fast as this computer can, "
           "and the same report every time")
        ->check(finite_number(0, std::numeric_limits<double>::max()));
    app->add_option(
           "--charge-planning", charge_,
           "in virtual time, let planning take as long as on a computer so many times slower than this "
           "one; 0, the default, lets it take none, since what this computer needs differs each time")
        ->check(finite_number(0, 1e6))
        ->type_name("K");
    printer_.declare(*app);
    declare_log(*app);
    app->footer(app->get_footer() + "\n\n" + fault_footer());
  }

  void declare_plan() {
    CLI::App* app = command("plan", "write a G-code file", "unicursal plan heart.toml -o heart.gcode");
    job_.declare(*app);
    app->add_option("-o,--output", output_, "the G-code file")->required()->type_name("FILE");
  }

  void declare_print() {
    CLI::App* app =
        command("print", "stream to a printer over USB", "unicursal print heart.toml --port /dev/ttyUSB0");
    job_.declare(*app);
    job_.declare_full_quality(*app);
    app->add_option("--port", port_, "serial port, or auto; the default is the profile's")->type_name("PORT");
    declare_control(*app);
    declare_spool(*app);
    declare_log(*app);
  }

  void declare_log(CLI::App& app) {
    app.add_option("--log", log_, "write every byte of the serial line to FILE; old ones become FILE.1, …")
        ->type_name("FILE");
  }

  void declare_json(CLI::App& app) {
    app.add_flag("--json", json_, "events on standard output, one JSON object on each line");
  }

  void declare_pause_heat(CLI::App& app) {
    app.add_option("--pause-heat", pause_heat_,
                   "what becomes of the nozzle's heat in a pause: keep (the default; for a quarter of an "
                   "hour) or lower")
        ->check(CLI::IsMember({"keep", "lower"}));
  }

  void declare_control(CLI::App& app) {
    declare_json(app);
    declare_pause_heat(app);
    app.footer(
        app.get_footer() +
        "\n\nIn a terminal, a word and Enter steers the print: pause, resume, cancel (parks and cools), "
        "stop (at\nonce), speed 80, flow 95 (per cent), nozzle 205, bed 55 (°C). Ctrl-C is cancel, "
        "twice is stop.");
  }

  PauseHeat pause_heat() const { return pause_heat_ == "lower" ? PauseHeat::lower : PauseHeat::keep; }

  void declare_spool(CLI::App& app) {
    app.add_option("--spool", spool_,
                   "folder in which prints are kept so that they can be resumed; the default is "
                   "unicursal/prints in $XDG_STATE_HOME or ~/.local/state")
        ->type_name("DIR");
  }

  void declare_doctor() {
    CLI::App* app =
        command("doctor", "ask a printer what it is, and tell what would go wrong; nothing moves or heats",
                "unicursal doctor --port auto");
    app->add_option("--port", port_, "serial port, or auto; the default is the profile's, or auto")
        ->type_name("PORT");
    app->add_option("--profile", job_.profile, "the printer's profile, to be held against what it tells")
        ->type_name("FILE");
    doctor_baud_given_ = app->add_option("--baud", baud_, "bits/s; the default is the profile's, or 250000")
                             ->check(finite_number(300, 4e6))
                             ->type_name("RATE");
    app->add_flag("--json", json_, "print what was found as JSON");
    declare_log(*app);
  }

  void declare_resume() {
    CLI::App* app = command("resume", "go on with a print that was interrupted", "unicursal resume");
    app->add_option("print", print_, "which one: its name or the beginning of it; the default is the newest")
        ->type_name("PRINT");
    declare_spool(*app);
    declare_state(*app);
    app->add_option("--port", port_, "serial port, or auto; the default is the one that it was begun on")
        ->type_name("PORT");
    declare_log(*app);
    app->add_flag("--yes", yes_, "go on without asking when the printer has lost its place");
    app->add_flag("--list", list_, "only list the prints that are kept");
    app->footer(
        app->get_footer() +
        "\n\nWhen a daemon (`unicursal serve`) holds a print, that one goes on. Otherwise it is for a print "
        "that\nwas broken off. If the printer is still on and hot, it goes on with the next line: none is "
        "lost, none is "
        "run\ntwice. If it was reset or cooled, you are told where the print stopped, and asked: the "
        "nozzle\nheats where it stands, rises, homes x and y only, squeezes out plastic beside the "
        "part, and\ngoes on at the last place that is certain. z cannot be homed on the part, so it "
        "must not have\nbeen moved. The profile's own start lines are not run again.");
    declare_control(*app);
  }

  void declare_state(CLI::App& app) {
    app.add_option("--state", state_,
                   "folder of the daemon; the default is unicursal/daemon in $XDG_STATE_HOME or "
                   "~/.local/state")
        ->type_name("DIR");
  }

  void declare_serve() {
    CLI::App* app = command("serve", "own the printer, keep a queue of jobs, and be steered over HTTP",
                            "unicursal serve --port /dev/ttyUSB0 --profile diamond.toml --jobs ~/jobs");
    app->add_option("--port", port_, "serial port, or auto; the default is the profile's")->type_name("PORT");
    app->add_option("--profile", job_.profile, "the printer's profile, instead of those that jobs name")
        ->type_name("FILE");
    app->add_option("--jobs", job_folders_, "folder whose jobs may be queued; may be given several times")
        ->type_name("DIR")
        ->take_all()
        ->expected(1);
    app->add_option("--listen", serve_.listen, "address and port; 127.0.0.1:8377 is the default")
        ->type_name("ADDRESS");
    app->add_option("--name", serve_.names, "another name of this computer by which clients come")
        ->type_name("HOST")
        ->take_all()
        ->expected(1);
    app->add_flag("--no-token", serve_.no_token, "let everyone on this computer steer; only on loopback");
    declare_state(*app);
    declare_spool(*app);
    declare_pause_heat(*app);
    app->footer(
        app->get_footer() +
        "\n\nA print is begun by `unicursal start`, never by itself: the last part may still lie on the "
        "bed.\nSIGTERM or Ctrl-C parks and cools a print that is going on, and waits for that; once more "
        "stops the\nprinter at once. The API is described in API.md.");
  }

  void declare_remote() {
    const std::pair<const char*, const char*> words[] = {
        {"status", "what the daemon does"},
        {"start", "let the daemon print the job that waits first, or the one of this number"},
        {"pause", "hold the daemon's print: it parks, and waits for resume"},
        {"cancel", "end the daemon's print: it parks and cools"},
        {"stop", "stop the daemon's printer at once (M112); it needs a reset afterwards"}};
    for (const auto& [word, what] : words) {
      CLI::App* app = command(word, what, std::string("unicursal ") + word);
      declare_state(*app);
      app->add_flag("--json", json_, "the daemon's own answer");
      if (std::string(word) == "start")
        app->add_option("job", job_number_, "its number")->type_name("NUMBER");
    }
    declare_set();
    CLI::App* app = command("queue", "the daemon's jobs", "unicursal queue --add leaf.toml");
    declare_state(*app);
    app->add_flag("--json", json_, "the daemon's own answer");
    app->add_flag("--jobs", list_, "list the jobs that can be added");
    CLI::Option* add =
        app->add_option("--add", queue_add_, "a job in the daemon's folders")->type_name("JOB");
    app->add_option("--upload", queue_upload_, "a job of your own, sent with the files that it names")
        ->type_name("FILE")
        ->excludes(add);
    app->add_option("--layers", job_.layers, "of it, these only: first:last counted from 0")
        ->type_name("A:B");
    app->add_option("--remove", queue_remove_, "take the job of this number away")->type_name("NUMBER");
  }

  void declare_set() {
    CLI::App* app = command("set", "change the speed, flow or heat of the daemon's print",
                            "unicursal set --flow 95 --nozzle 205");
    declare_state(*app);
    app->add_flag("--json", json_, "the daemon's own answer");
    const auto option = [&](const char* name, std::optional<double>& value, const char* what) {
      app->add_option(name, value, what)->check(finite_number(0, 1000))->type_name("NUMBER");
    };
    option("--speed", set_.speed, "per cent of what the print asks for, 10 to 300");
    option("--flow", set_.flow, "per cent of what the print asks for, 50 to 200");
    option("--nozzle", set_.nozzle, "°C; the print's own changes still come");
    option("--bed", set_.bed, "°C");
  }

  /// Whoever names a kept print, or where prints are kept, does not mean the daemon's.
  bool means_daemon() const { return !list_ && print_.empty() && (spool_.empty() || !state_.empty()); }

  RemoteCommand remote_command(const std::string& word) const {
    return {word, path_if(state_), json_, job_number_};
  }

  QueueCommand queue_command() const {
    QueueCommand command{remote_command("queue"), text_if(queue_add_), path_if(queue_upload_), {}, {}, list_};
    if (!job_.layers.empty()) command.layers = parse_layers(job_.layers);
    command.remove = queue_remove_;
    return command;
  }

  ServeOptions serve_options() const {
    ServeOptions options = serve_;
    options.daemon.state = state_.empty() ? default_state_folder() : std::filesystem::path(state_);
    options.daemon.jobs.assign(job_folders_.begin(), job_folders_.end());
    options.daemon.port = text_if(port_);
    options.daemon.profile = path_if(job_.profile);
    options.daemon.spool = path_if(spool_);
    options.daemon.pause_heat = pause_heat();
    return options;
  }

  void declare_curve() {
    CLI::App* app =
        command("curve", "write the curve of one island",
                "unicursal curve heart.toml --layer 0 -o heart.txt -o heart.svg --report heart.json");
    app->add_option("job", job_.job, "the job, a TOML file")->required()->type_name("JOB");
    app->add_option("--profile", job_.profile, "printer profile instead of the one that the job names")
        ->type_name("FILE");
    app->add_option("--layer", layer_, "counted from 0")->check(finite_number(0, 1e9))->type_name("N");
    app->add_option("--island", island_, "counted from 0, the largest")
        ->check(finite_number(0, 1e9))
        ->type_name("K");
    app->add_option("-o,--output", outputs_, ".txt (x y width), .svg or .png; may be given several times")
        ->type_name("FILE");
    app->add_option("--report", job_.report, "write what was measured as JSON")->type_name("FILE");
    app->add_option("--picture", job_.pictures,
                    "write a picture of each stage into this folder, from 1-field.png to 6-width.png")
        ->type_name("DIR");
    app->add_option("--threads", job_.threads,
                    "that share the island, 1 by default; any number gives the same bytes")
        ->check(finite_number(1, most_threads))
        ->type_name("N");
    app->add_option("--preset", preset_, "weights of the optimisers: best (the default) or paper")
        ->check(CLI::IsMember({"best", "paper"}));
    app->add_option("--quality", quality_, "how long the optimisers run; 1 is the default, more is better")
        ->check(finite_number(0.01, 1000));
    app->add_option("--budget", budget_, "s of planning, after which what there is is finished")
        ->check(finite_number(0, 1e6))
        ->type_name("SECONDS");
    app->add_option("--replay", replay_, "spend the effort again that an earlier --report tells: same bytes")
        ->type_name("FILE");
  }

  void declare_simulate() {
    CLI::App* app = command("simulate", "be a simulated printer on a pseudo-terminal, and print its path",
                            "unicursal simulate --link printer --speed 10 --report seen.json");
    app->add_option("--link", link_, "symbolic link to make to the pseudo-terminal")->type_name("PATH");
    app->add_option("--speed", speed_, "printer seconds per second; 0, the default, is as fast as lines come")
        ->check(finite_number(0, std::numeric_limits<double>::max()));
    app->add_option("--profile", job_.profile,
                    "bed, filament, feeders, speeds, accelerations and chamber of this printer")
        ->type_name("FILE");
    app->add_option("--report", job_.report, "write what was seen as JSON at the end")->type_name("FILE");
    app->add_option("--picture", job_.pictures,
                    "write pictures of each layer, the part and the motion into this folder")
        ->type_name("DIR");
    app->add_option("--pixel", pixel_, "mm per picture pixel")
        ->check(finite_number(0.01, 10))
        ->type_name("MM");
    app->add_option("--rasters", rasters_,
                    "write every layer as laid to this file or pipe (sim/bed/raster.hpp)")
        ->type_name("FILE");
    app->add_flag("--once", once_, "end when a host has used the line and closed it");
    baud_given_ =
        app->add_option("--baud", baud_, "bits/s of the line; the default is the profile's, or 250000")
            ->check(finite_number(300, 1e8))
            ->type_name("RATE");
    app->add_option("--transcript", transcript_, "write every command as it is executed")->type_name("FILE");
    app->add_option("--control", control_,
                    "make a Unix socket on which the host says how far printer time goes (sim/lockstep.hpp)")
        ->type_name("PATH");
    printer_.declare(*app);
    app->footer(
        app->get_footer() +
        "\n  pronterface, OctoPrint or any other host then connects to ./printer\n\nWith speed 0 bytes "
        "take no time, and what takes time is over at once.\n\n" +
        fault_footer());
  }

  void declare_tune() {
    CLI::App* app = command("tune", "print and read what a profile has to know",
                            "unicursal tune transition diamond.toml");
    app->require_subcommand(1);
    tune_.declare(*app);
  }

  CurveCommand curve_command() const {
    CurveCommand command;
    command.job = job_.job;
    command.profile = path_if(job_.profile);
    command.layer = layer_;
    command.island = island_;
    command.report = path_if(job_.report);
    command.pictures = path_if(job_.pictures);
    command.threads = std::max(static_cast<int>(job_.threads), 1);
    command.outputs.assign(outputs_.begin(), outputs_.end());
    command.preset = preset_ == "paper" ? core::Preset::paper : core::Preset::best;
    command.quality = quality_;
    command.budget = budget_;
    command.replay = path_if(replay_);
    return command;
  }

  DoctorCommand doctor_command() const {
    DoctorCommand command{text_if(port_), path_if(job_.profile), {}, path_if(log_), json_};
    if (doctor_baud_given_->count() > 0) command.baud = static_cast<unsigned>(baud_);
    return command;
  }

  DryRunCommand dry_run_command() const {
    DryRunCommand command{job_.options(), {}, printer_.chosen(), charge_, path_if(log_), {json_}};
    printer_.apply(command.printer);
    command.printer.speed = speed_;
    return command;
  }

  SimulateCommand simulate_command() const {
    SimulateCommand command;
    command.personality_chosen = printer_.chosen();
    printer_.apply(command.options);
    command.options.control = path_if(control_);
    command.options.transcript = path_if(transcript_);
    if (baud_given_->count() > 0) command.baud = baud_;
    command.profile = path_if(job_.profile);
    command.options.link = path_if(link_);
    command.options.speed = speed_;
    command.options.report = path_if(job_.report);
    command.options.pictures = path_if(job_.pictures);
    command.options.pixel = pixel_;
    command.options.rasters = path_if(rasters_);
    command.options.once = once_;
    return command;
  }

  std::string preset_ = "best", replay_;
  double quality_ = 1;
  std::optional<double> budget_;
  CLI::App app_{"One closed space-filling curve per layer, for printers with three feeders and one nozzle.",
                "unicursal"};
  JobArguments job_;
  PrinterArguments printer_;
  TuneArguments tune_;
  double speed_ = 0, charge_ = 0, baud_ = 250000;
  CLI::Option *baud_given_ = nullptr, *doctor_baud_given_ = nullptr;
  bool json_ = false;
  std::string log_;
  double pixel_ = 0.05;
  std::size_t layer_ = 0, island_ = 0;
  bool yes_ = false, list_ = false;
  std::string state_, queue_add_, queue_upload_;
  std::vector<std::string> job_folders_;
  std::optional<std::uint64_t> job_number_, queue_remove_;
  ServeOptions serve_;
  SetCommand set_;
  std::string pause_heat_ = "keep";
  std::string spool_, print_;
  std::string output_, port_, link_, rasters_, control_, transcript_;
  std::vector<std::string> outputs_;
  bool once_ = false;
};

int report(const std::exception& error, Exit code) {
  show(stderr, "unicursal: {}\n", error.what());
  return static_cast<int>(code);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed terminal must not end a print
  std::signal(SIGXFSZ, SIG_IGN);  // nor a limit on file sizes: it is told like a full disk
  try {
    CommandLine line;
    try {
      return static_cast<int>(line.run(argc, argv));
    } catch (const CLI::ParseError& error) {
      return line.exit(error);
    }
  } catch (const core::DataError& error) {
    return report(error, Exit::bad_input);
  } catch (const PortError& error) {
    return report(error, Exit::bad_input);
  } catch (const PrinterUnfit& error) {
    return report(error, Exit::bad_input);
  } catch (const std::filesystem::filesystem_error& error) {
    // Before a print: within one, everything becomes a PrintError.
    show(stderr, "unicursal: {}: {}; check the name and the permissions\n", error.path1().string(),
         error.code().message());
    return static_cast<int>(Exit::bad_input);
  } catch (const std::exception& error) {
    return report(error, Exit::failed);
  }
}

}  // namespace unicursal::host
