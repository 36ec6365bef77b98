#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/cli/words.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {

Exit print(const PrintCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job);
  Run run(prepared, "print", command.job.outputs);
  const Profile& profile = prepared.job.profile;
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  check_beginning(prepared, lookahead);
  const int port = open_port(command.port.value_or(profile.port), profile.baud);
  const StreamResult result = stream_with_progress(port, lookahead, run, "printing");
  conclude(run, result, {{"planning", planning_json(lookahead)}});
  show(stdout, "{}", summary(run.totals(), lookahead.effort()));
  if (result.ending == Ending::completed) return Exit::success;
  show(stdout, "stopped by the user; the printer is {}\n", result.parked ? "parked and cooling" : "cooling");
  return Exit::failed;
}

}  // namespace unicursal::host
