#include "host/dry_run/dry_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/dry_run/dry_run_view.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/dry_run/simulator_process.hpp"
#include "host/engine/planned_production.hpp"
#include "host/engine/session.hpp"
#include "host/report/deposit_check.hpp"
#include "host/report/open_books.hpp"
#include "host/report/print_report.hpp"

namespace unicursal::host {
namespace {

constexpr double unattended_pause = 60;  ///< s, after which a pause ends by itself

/// Real time is for watching how the host keeps pace; virtual time is fast and repeats exactly.
bool is_virtual(const DryRunOptions& options) {
  return options.printer.speed == 0;
}

/// The firmware that the profile is written for, unless another one is asked for.
std::string personality_of(const DryRunOptions& options, const Job& job) {
  return options.personality_chosen ? options.printer.personality : job.profile.printer.firmware;
}

std::vector<std::string> simulator_arguments(const DryRunOptions& options, const Job& job) {
  const sim::SimulatorOptions& printer = options.printer;
  std::vector<std::string> arguments = {"--profile",     job.profile.file.string(),
                                        "--speed",       fmt::format("{}", printer.speed),
                                        "--baud",        fmt::format("{}", job.profile.baud),
                                        "--personality", personality_of(options, job),
                                        "--usb",         printer.usb};
  for (const std::string& fault : printer.faults) arguments.insert(arguments.end(), {"--fault", fault});
  if (printer.fault_file) arguments.insert(arguments.end(), {"--faults", printer.fault_file->string()});
  if (printer.tanks) arguments.insert(arguments.end(), {"--tanks", fmt::format("{}", *printer.tanks)});
  if (printer.seed) arguments.insert(arguments.end(), {"--seed", fmt::format("{}", *printer.seed)});
  if (options.outputs.pictures) {
    arguments.insert(arguments.end(), {"--picture", options.outputs.pictures->string()});
  }
  return arguments;
}

Comparison compare_with(const nlohmann::json& simulator, const Books& books, const StreamResult& result) {
  Fed fed;
  const gcode::Printer& printer = books.job().profile.printer;
  fed.filament_diameter = printer.filament_diameter;
  fed.feeder_steps_per_mm = printer.extruder_steps.value_or(sim::SimulatorOptions{}.feeder_steps_per_mm);
  fed.flow_factors = printer.flow_factors;
  fed.lines_sent = result.statistics.lines + result.statistics.queries;
  return compare(books.fed(), simulator, fed);
}

StreamSettings settings_for(const DryRunOptions& options, const Profile& profile,
                            const SimulatorProcess& simulator) {
  StreamSettings settings;
  settings.link = link_options(profile, options.log);
  settings.profile = profile.file;
  settings.longest_pause = unattended_pause;
  if (is_virtual(options)) {
    settings.clock = std::make_shared<LockstepClock>(simulator.control());
  } else {
    settings.clock = real_clock(options.printer.speed);
  }
  return settings;
}

/// In virtual time, planning takes `charge` times its real time; if that is 0, it never hurries.
void begin(Production& production, const DryRunOptions& options, const StreamSettings& settings) {
  auto* const planned = dynamic_cast<PlannedProduction*>(&production);
  if (!planned || !is_virtual(options)) return production.begin(settings.clock, {});
  LookaheadOptions planning = paced(lookahead_options(planned->prepared()), settings.clock);
  planning.pace.reset();
  if (options.charge > 0) planning.pace = PlanningClock{{}, options.charge};
  planned->plan(planning);
}

/// In virtual time the report leaves out this computer's times, so that equal dry runs give equal reports.
nlohmann::json planning_of(const DryRunOptions& options, const Production& production,
                           const StreamResult& result) {
  nlohmann::json planning = nlohmann::json::object();
  if (const auto done = production.planning())
    planning = is_virtual(options) ? nlohmann::json{{"charge", options.charge}} : planning_json(*done);
  planning["waited_seconds"] = result.waited;
  return planning;
}

RunOutputs outputs_of(const DryRunOptions& options) {
  RunOutputs outputs = options.outputs;
  outputs.repeatable = is_virtual(options);
  return outputs;
}

/// Removes thousands of numbers that are of no use once they have been judged.
void leave_out_histograms(nlohmann::json& simulator) {
  const auto motion = simulator.find("motion");
  if (motion == simulator.end() || !motion->is_object()) return;
  motion->erase("flow_seconds");
  motion->erase("flow_by_second");
}

/// The report of a failed print includes the simulator's, if there is one.
void conclude_failed(Books& books, const StreamResult& result, nlohmann::json extra,
                     SimulatorProcess& simulator) {
  try {
    extra["simulator"] = simulator.finish();
  } catch (const SimulatorError&) {
    // The reason why the print failed is reported; the simulator's would distract from it.
  }
  conclude(books, result, extra);
}

/// The simulator's own report. If the simulator fails at its very end, the dry run has failed.
nlohmann::json seen_by(SimulatorProcess& simulator, Books& books, StreamResult result, DepositCheck& check,
                       const nlohmann::json& planning) {
  try {
    return simulator.finish();
  } catch (const SimulatorError& error) {
    check.finish();
    result.ending = Ending::failed;
    result.reason = error.what();
    conclude(books, result, {{"planning", planning}, {"laid", check.to_json()}});
    throw;
  }
}

/// The simulator looks at every move, while the plan only keeps parts apart.
std::vector<std::string> warnings_of_strikes(const nlohmann::json& simulator) {
  const nlohmann::json struck = simulator.value("struck", nlohmann::json::object());
  const auto moves = struck.value("by_nozzle", 0) + struck.value("by_head", 0);
  if (moves == 0) return {};
  const std::vector<double> at = struck.at("first");
  return {fmt::format(
      "the head struck what it had printed on {} {}, first at ({:.1f}, {:.1f}, {:.2f}) mm; do not print "
      "this job; if it was in the profile's own lines, raise the nozzle there, else report a fault of "
      "this program",
      moves, moves == 1 ? "move" : "moves", at.at(0), at.at(1), at.at(2))};
}

}  // namespace

DryRunResult dry_run(Production& production, const DryRunOptions& options, const Streamer& stream) {
  production.check();
  const Job& job = production.job();
  const std::unique_ptr<Books> books = open_books(production, "dry-run", outputs_of(options));
  const auto& pictures = options.outputs.pictures;
  if (pictures) remove_view(*pictures);
  // Declared before the simulator: it waits for the end of the stream, which comes when the simulator ends.
  DepositCheck check(books->intended_materials(), pictures, books->job().profile.filaments.colours());
  SimulatorProcess simulator(simulator_arguments(options, job), is_virtual(options)
                                                                    ? SimulatorProcess::Time::lockstep
                                                                    : SimulatorProcess::Time::own);
  books->judge_with(check);
  check.watch(simulator.take_rasters());
  StreamSettings settings = settings_for(options, job.profile, simulator);
  begin(production, options, settings);
  const int port = open_port(simulator.port(), job.profile.baud);
  const StreamResult result = stream(port, production.open({}), settings);
  settings.clock.reset();  // hangs up, which the simulator waits for
  const nlohmann::json planning = planning_of(options, production, result);
  if (result.ending == Ending::failed) conclude_failed(*books, result, {{"planning", planning}}, simulator);
  nlohmann::json seen = seen_by(simulator, *books, result, check, planning);
  check.finish();
  const MotionFindings motion = motion_findings(seen, production.flow());
  leave_out_histograms(seen);
  const Comparison comparison = compare_with(seen, *books, result);
  const nlohmann::json view = view_of({*books, result, seen, check, motion, comparison});
  conclude(*books, result,
           {{"planning", planning},
            {"grades", grades_in(view)},
            {"simulator", seen},
            {"comparison", to_json(comparison)},
            {"laid", check.to_json()},
            {"motion", to_json(motion)}});
  if (pictures) write_view(*pictures, view);
  production.check_made();
  std::vector<std::string> warnings = production.late_warnings();
  for (std::string& warning : warnings_of_strikes(seen)) warnings.push_back(std::move(warning));
  return {result,
          books->totals(),
          books->summary(production.planning()),
          books->summary(motion) + books->summary(check.total()),
          comparison,
          motion,
          check.total(),
          std::move(warnings),
          check.problem()};
}

}  // namespace unicursal::host
