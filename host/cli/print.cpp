#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/words.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {

Exit print(const PrintCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job);
  Run run(prepared, "print", command.job.outputs);
  const Profile& profile = prepared.job.profile;
  const int port = open_port(command.port.value_or(profile.port), profile.baud);
  Lookahead lookahead(*prepared.part, lookahead_options(prepared));
  const StreamResult result = stream_with_progress(port, lookahead, run, "printing");
  run.write_report({{"ended", result.stopped ? "stopped" : "completed"},
                    {"planning", planning_json(lookahead)},
                    {"link", link_json(result)}});
  fmt::print("{}", summary(run.totals(), lookahead.effort()));
  if (result.stopped) fmt::print("stopped by the user; the printer is parked and cooling\n");
  return result.stopped ? Exit::failed : Exit::success;
}

}  // namespace unicursal::host
