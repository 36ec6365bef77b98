#include "host/dry_run/dry_run.hpp"

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {

Exit dry_run(const DryRunCommand& command) {
  check_simulator(command.printer);
  const PreparedJob prepared = prepare_and_warn(command.job, present({command.log}));
  check_outputs(present({command.printer.fault_file}), present({command.job.outputs.report, command.log}));
  const DryRunOptions options{command.printer, command.personality_chosen, command.charge, command.log,
                              command.job.outputs};
  const DryRunResult result =
      dry_run(prepared, options, [&](int port, Source& source, const StreamSettings& settings) {
        return stream_with_progress(port, source, command.display, settings);
      });
  show(words_of(command.display), "{}", summary(result.totals, result.effort));
  const Exit exit = tell_ending(result.stream, command.display);
  if (exit != Exit::success) return exit;
  show(words_of(command.display), "{}{}{}", summary(result.comparison), summary(result.motion),
       summary(result.laid));
  if (result.problem) show(stderr, "warning: {}\n", *result.problem);
  return result.comparison.lines_whole() ? Exit::success : Exit::failed;
}

}  // namespace unicursal::host
