// What each command of the command line does, once its options are known. They throw; cli.cpp turns that
// into sentences and exit codes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/planner/island_plan.hpp"
#include "host/cli/cli.hpp"
#include "host/daemon/serve.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/session_types.hpp"
#include "host/report/books.hpp"
#include "host/tune/strip_print.hpp"
#include "sim/simulator_options.hpp"

namespace unicursal::host {

/// What the commands that take a whole job share.
struct JobOptions {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;
  std::optional<LayerRange> layers;
  RunOutputs outputs;
  std::size_t threads = 0;    ///< that plan; 0: one for each core
  bool look_ahead = true;     ///< of the mixing schedule
  bool full_quality = false;  ///< planning never hurries
};

/// How a print shows what it does, and what it does when it is held.
struct DisplayOptions {
  bool json = false;  ///< events on standard output
};

struct PlanCommand {
  JobOptions job;
  std::filesystem::path output;  ///< G-code
};

struct DryRunCommand {
  JobOptions job;
  sim::SimulatorOptions printer;    ///< its personality, chip, faults; and its speed, 0: virtual time
  bool personality_chosen = false;  ///< otherwise it is what the profile's firmware is
  double charge = 0;                ///< printer seconds for each second of planning, in virtual time
  std::optional<std::filesystem::path> log;  ///< of the serial line
  DisplayOptions display;
};

struct PrintCommand {
  JobOptions job;
  std::optional<std::string> port;             ///< absent: the profile's
  std::optional<std::filesystem::path> spool;  ///< folder of the prints; absent: the user's
  std::optional<std::filesystem::path> log;    ///< of the serial line
  DisplayOptions display;
  PauseHeat pause_heat = PauseHeat::keep;
};

struct ResumeCommand {
  std::optional<std::string> print;            ///< name or beginning of it, or a folder; absent: the newest
  std::optional<std::filesystem::path> spool;  ///< folder of the prints
  std::optional<std::string> port;             ///< absent: the print's
  std::optional<std::filesystem::path> log;    ///< of the serial line
  bool yes = false;                            ///< agree to what would be asked
  bool list = false;                           ///< only tell which prints there are
  DisplayOptions display;
  PauseHeat pause_heat = PauseHeat::keep;
};

struct DoctorCommand {
  std::optional<std::string> port;               ///< absent: the profile's, or auto
  std::optional<std::filesystem::path> profile;  ///< what the printer is believed to be
  std::optional<unsigned> baud;                  ///< absent: the profile's, or 250000
  std::optional<std::filesystem::path> log;      ///< of the serial line
  bool json = false;
};

/// One that a daemon is asked to do: status, start, pause, resume, cancel, stop.
struct RemoteCommand {
  std::string word;
  std::optional<std::filesystem::path> state;  ///< the daemon's folder
  bool json = false;
  std::optional<std::uint64_t> id;  ///< of the job to start
};

/// What is changed of the daemon's print.
struct SetCommand {
  RemoteCommand remote;
  std::optional<double> speed, flow;  ///< % of what the print asks for
  std::optional<double> nozzle, bed;  ///< °C
};

struct QueueCommand {
  RemoteCommand remote;
  std::optional<std::string> add;               ///< by its name in the daemon's folders
  std::optional<std::filesystem::path> upload;  ///< a job of this user's, with what it needs
  std::optional<LayerRange> layers;             ///< of the one that is added
  std::optional<std::uint64_t> remove;          ///< its number
  bool list_jobs = false;                       ///< those that can be added
};

struct CurveCommand {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;
  std::size_t layer = 0;
  std::size_t island = 0;  ///< 0: the largest
  std::vector<std::filesystem::path> outputs;
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> pictures;  ///< folder, for one of each stage
  int threads = 1;                                ///< that share the island
  core::Preset preset = core::Preset::best;
  double quality = 1;                           ///< how long the optimisers run
  std::optional<double> budget;                 ///< s of planning; what there is then is finished
  std::optional<std::filesystem::path> replay;  ///< a report whose effort is to be spent again
};

struct SimulateCommand {
  sim::SimulatorOptions options;
  std::optional<std::filesystem::path> profile;  ///< of the printer to be
  std::optional<double> baud;                    ///< bits/s; absent: the profile's
  bool personality_chosen = false;               ///< otherwise the profile's firmware counts, if there is one
};

struct TuneCommand {
  std::filesystem::path profile;
  StripFeeders feeders;
  std::optional<double> range;                  ///< mm³ that the strip holds
  std::optional<std::filesystem::path> output;  ///< G-code
  std::optional<std::string> port;
  bool simulate = false;
  std::optional<std::filesystem::path> machine;   ///< the simulated printer's profile
  std::size_t tanks = 2;                          ///< of the simulated nozzle
  std::optional<std::filesystem::path> pictures;  ///< folder
  bool read_simulated = false;                    ///< off the raster instead of asking
  std::optional<double> began, half, stopped;     ///< ticks
  bool yes = false;                               ///< write without asking
};

Exit plan(const PlanCommand& command);
Exit dry_run(const DryRunCommand& command);
Exit print(const PrintCommand& command);
Exit resume(const ResumeCommand& command);
Exit serve(const ServeOptions& options);
Exit remote(const RemoteCommand& command);
Exit queue(const QueueCommand& command);
Exit set(const SetCommand& command);
/// Whether a daemon is there and at a print: `resume` is for that one then.
bool daemon_prints(const RemoteCommand& command);
Exit curve(const CurveCommand& command);
Exit simulate(SimulateCommand command);
Exit tune(const TuneCommand& command);
/// Throws core::DataError for a printer that cannot be simulated.
void check_simulator(const sim::SimulatorOptions& options);
Exit ports();
Exit doctor(const DoctorCommand& command);

/// "3", "3:7", ":7" or "3:"; both ends included. Throws core::DataError.
LayerRange parse_layers(const std::string& text);

}  // namespace unicursal::host
