#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/report/summary.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {
namespace {

PrintOrder order_of(const PrintCommand& command, const PreparedJob& prepared) {
  PrintOrder order;
  order.job_name = prepared.job.file.stem().string();
  order.port = command.port.value_or(prepared.job.profile.port);
  order.layer_count = prepared.count;
  if (command.job.layers) order.layers = std::pair(command.job.layers->first, command.job.layers->last);
  return order;
}

}  // namespace

Exit print(const PrintCommand& command) {
  const PreparedJob prepared = prepare_and_warn(command.job, present({command.log}));
  Run run(prepared, "print", command.job.outputs);
  PrintOrder order = order_of(command, prepared);
  check_beginning(prepared);
  StreamSettings settings;
  settings.pause_heat = command.pause_heat;
  settings.profile = prepared.job.profile.file;
  Lookahead lookahead(*prepared.part, paced(lookahead_options(prepared), settings.clock));
  settings.link = link_options(prepared.job.profile, command.log);
  const int port = open_port(order.port, prepared.job.profile.baud, settings.link);
  order.device = device_of(port);
  Spool spool = Spool::create(command.spool ? *command.spool : default_spool_root(), prepared.job, order);
  settings.spool = &spool;
  PlannedSource source(lookahead, run);
  const StreamResult result = stream_with_progress(port, source, command.display, settings);
  tell_about_spool(spool, result);
  conclude(run, result, {{"planning", planning_json(lookahead)}});
  if (result.ending == Ending::completed)
    show(words_of(command.display), "{}", summary(run.totals(), lookahead.effort()));
  return tell_ending(result, command.display);
}

}  // namespace unicursal::host
