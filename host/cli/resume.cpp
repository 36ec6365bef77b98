#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/engine/print.hpp"
#include "host/engine/restart.hpp"
#include "host/spool/spool.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

fs::path root_of(const ResumeCommand& command) {
  return command.spool ? *command.spool : default_spool_root();
}

Exit list(const fs::path& root) {
  for (const fs::path& folder : kept_prints(root)) {
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

fs::path chosen_print(const ResumeCommand& command) {
  const fs::path root = root_of(command);
  const std::vector<fs::path> prints = kept_prints(root);
  if (prints.empty()) {
    throw SpoolError(root.string(), "", "holds no print", "name the folder of the prints with --spool");
  }
  if (!command.print) return prints.front();
  const auto found = [&](const auto& fits) {
    return std::find_if(prints.begin(), prints.end(),
                        [&](const fs::path& folder) { return fits(folder.filename().string()); });
  };
  // A whole name is meant as such, even where another begins with it.
  auto print = found([&](const std::string& name) { return name == *command.print; });
  if (print == prints.end())
    print = found([&](const std::string& name) { return name.starts_with(*command.print); });
  if (print != prints.end()) return *print;
  throw SpoolError(root.string(), "", "holds no print whose name begins with \"" + *command.print + "\"",
                   "see `unicursal resume --list`");
}

void tell(const Restart& restart, const Lost& lost, const Spool& spool) {
  show(stdout, "The printer cannot simply go on: {}.\n", lost.why);
  if (restart.from_start()) {
    show(stdout, "Nothing had been laid yet: the print begins anew.\n");
    return;
  }
  if (restart.layer) {
    show(stdout, "The print goes on in layer {} of {}, at z = {:.2f} mm.\n", restart.layer->index + 1,
         spool.order().layer_count, restart.layer->top);
  }
  if (restart.repeated > 0) {
    show(stdout,
         "Up to there everything is certain; of the next {} lines some may have been run and are run "
         "again.\n",
         restart.repeated);
  }
  show(stdout,
       "The nozzle heats where it stands, rises, homes x and y (not z, where the part is), squeezes out "
       "plastic "
       "beside the\npart, and goes on. Its height is taken to be {:.2f} mm: do not go on if z was moved by "
       "hand or has sunk.\n",
       restart.lowest);
  if (restart.highest > restart.lowest) {
    show(stdout,
         "It was on its way up: it may be as high as {:.2f} mm, and the rest then lies that much too high.\n",
         restart.highest);
  }
  show(stdout, "Speed, flow and heat that were set by hand while it printed are the job's again.\n");
  for (const std::string& warning : restart.warnings) show(stdout, "note: {}\n", warning);
}

bool agreed(const ResumeCommand& command, const Restart& restart) {
  const bool sure = restart.highest <= restart.lowest;
  if (command.yes && sure) return true;
  if (isatty(STDIN_FILENO) == 0) {
    throw SpoolError("", "",
                     sure ? "nobody is there to be asked" : "nobody is there to see how high the nozzle is",
                     sure ? "say --yes if the print shall go on like that"
                          : "resume at a terminal, without --yes or with it");
  }
  show(stdout, "Go on? [y/N] ");
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

StreamResult stream_from(Print& print, std::optional<Leg> leg, const ResumeCommand& command) {
  print.connect(std::move(leg));
  return stream_with_progress(print, command.display);
}

Exit end(Print& print, const StreamResult& result, const ResumeCommand& command) {
  tell_about_spool(print.spool(), result);
  throw_if_failed(result);
  return tell_ending(result, command.display);
}

Exit restart(Print& print, const Lost& lost, const ResumeCommand& command) {
  const Restart restart = restart_after(print.prepared(), print.spool(), lost);
  tell(restart, lost, print.spool());
  if (!agreed(command, restart)) {
    show(stdout,
         "The print was not gone on with. If the printer's heaters are on, they stay on: look after "
         "them.\n");
    return Exit::failed;
  }
  return end(print, stream_from(print, restart.leg, command), command);
}

Exit go_on(Print& print, const ResumeCommand& command) {
  const JournalState& before = print.spool().before();
  if (!before.parking.empty()) {
    const char* const why = before.aside ? "its nozzle was moved aside" : "it was parked and cooled";
    return restart(print, {why, std::nullopt}, command);
  }
  const bool nothing_sent = before.anchors.empty();
  const StreamResult result =
      stream_from(print, nothing_sent ? std::optional(before.leg) : std::nullopt, command);
  return result.lost ? restart(print, *result.lost, command) : end(print, result, command);
}

}  // namespace

Exit resume(const ResumeCommand& command) {
  if (command.list) return list(root_of(command));
  const fs::path folder = chosen_print(command);
  Spool spool = Spool::open(folder);
  const JournalState& before = spool.before();
  if (before.ended && before.ended->outcome == Outcome::completed) {
    show(stdout, "{}: this print was completed\n", folder.filename().string());
    return Exit::success;
  }
  if (before.superseded) {
    throw SpoolError(folder.string(), "", "cannot go on: another print was begun on its printer since",
                     "print the job anew");
  }
  Print print(std::move(spool), {command.port, command.spool, command.log, command.pause_heat});
  return go_on(print, command);
}

}  // namespace unicursal::host
