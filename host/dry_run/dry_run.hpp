// A print on the simulated printer. Planning, encoding and streaming are those of a real print; a simulator
// in a process of its own is at the other end of the line, and everything that it lays is compared with the
// job.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/production.hpp"
#include "host/engine/session_types.hpp"
#include "host/engine/source.hpp"
#include "host/report/books.hpp"
#include "host/report/deposit_findings.hpp"
#include "host/report/motion_findings.hpp"
#include "host/report/totals.hpp"
#include "sim/simulator_options.hpp"

namespace unicursal::host {

struct DryRunOptions {
  sim::SimulatorOptions printer;             ///< `speed` 0: virtual time
  bool personality_chosen = false;           ///< false: the simulator speaks the firmware of the profile
  double charge = 0;                         ///< s of virtual time for each second of planning
  std::optional<std::filesystem::path> log;  ///< of the serial line
  RunOutputs outputs;
};

struct DryRunResult {
  StreamResult stream;  ///< completed or stopped
  RunTotals totals;
  std::string summary;       ///< of the books: layers, material, times
  std::string laid_summary;  ///< of the books: motion, and what was laid
  Comparison comparison;
  MotionFindings motion;
  DepositFindings laid;
  std::vector<std::string> warnings;   ///< that became known while layers were made
  std::optional<std::string> problem;  ///< why judging what was laid ended early, if it did
};

/// Streams a print to the port, whose descriptor it takes over (stream.hpp).
using Streamer = std::function<StreamResult(int port, Source& source, const StreamSettings& settings)>;

/// Also writes the report. `production` must not have begun. Throws core::DataError, also after it if a layer
/// stays mostly without plastic and the job does not allow it, SimulatorError, and PrintError if the print
/// has failed.
DryRunResult dry_run(Production& production, const DryRunOptions& options, const Streamer& stream);

}  // namespace unicursal::host
