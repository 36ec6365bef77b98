// What each command of the command line does, once its options are known. They throw; cli.cpp turns that
// into sentences and exit codes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/planner/plan_island.hpp"
#include "host/cli/cli.hpp"
#include "host/daemon/serve.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/run.hpp"
#include "host/engine/session.hpp"
#include "sim/simulator.hpp"

namespace unicursal::host {

/// What the commands that take a whole job share.
struct JobOptions {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;
  std::optional<LayerRange> layers;
  RunOutputs outputs;
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
  sim::SimulatorOptions printer;  ///< its personality, chip, faults; and its speed, 0: virtual time
  double charge = 0;              ///< printer seconds for each second of planning, in virtual time
  DisplayOptions display;
};

struct PrintCommand {
  JobOptions job;
  std::optional<std::string> port;             ///< absent: the profile's
  std::optional<std::filesystem::path> spool;  ///< folder of the prints; absent: the user's
  DisplayOptions display;
  PauseHeat pause_heat = PauseHeat::keep;
};

struct ResumeCommand {
  std::optional<std::string> print;            ///< name or beginning of it, or a folder; absent: the newest
  std::optional<std::filesystem::path> spool;  ///< folder of the prints
  std::optional<std::string> port;             ///< absent: the print's
  bool yes = false;                            ///< agree to what would be asked
  bool list = false;                           ///< only tell which prints there are
  DisplayOptions display;
  PauseHeat pause_heat = PauseHeat::keep;
};

/// One that a daemon is asked to do: status, start, pause, resume, cancel, stop.
struct RemoteCommand {
  std::string word;
  std::optional<std::filesystem::path> state;  ///< the daemon's folder
  bool json = false;
  std::optional<std::uint64_t> id;  ///< of the job to start
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
  core::Preset preset = core::Preset::best;
  double quality = 1;                           ///< how long the optimisers run
  std::optional<double> budget;                 ///< s of planning; what there is then is finished
  std::optional<std::filesystem::path> replay;  ///< a report whose effort is to be spent again
};

struct SimulateCommand {
  sim::SimulatorOptions options;
  std::optional<std::filesystem::path> profile;  ///< bed, filament, accelerations and feeders of this printer
  std::optional<double> baud;                    ///< bits/s; absent: the profile's
};

Exit plan(const PlanCommand& command);
Exit dry_run(const DryRunCommand& command);
Exit print(const PrintCommand& command);
Exit resume(const ResumeCommand& command);
Exit serve(const ServeOptions& options);
Exit remote(const RemoteCommand& command);
Exit queue(const QueueCommand& command);
/// Whether a daemon is there and at a print: `resume` is for that one then.
bool daemon_prints(const RemoteCommand& command);
Exit curve(const CurveCommand& command);
Exit simulate(SimulateCommand command);
/// Throws core::DataError for a printer that cannot be simulated.
void check_simulator(const sim::SimulatorOptions& options);
Exit ports();

/// "3", "3:7", ":7" or "3:"; both ends included. Throws core::DataError.
LayerRange parse_layers(const std::string& text);

}  // namespace unicursal::host
