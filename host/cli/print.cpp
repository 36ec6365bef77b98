#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/common.hpp"
#include "host/cli/show.hpp"
#include "host/engine/print.hpp"
#include "host/report/print_report.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {

Exit print(const PrintCommand& command) {
  const PrintOptions options{command.port, command.spool, command.log, command.pause_heat};
  Print print(prepare_and_warn(command.job, present({command.log})), options);
  Books books(print.maker(), "print", command.job.outputs);
  print.connect();
  const StreamResult result = stream_with_progress(print, command.display);
  tell_about_spool(print.spool(), result);
  conclude(books, result, {{"planning", planning_json(print.lookahead())}});
  if (result.ending == Ending::completed) {
    show(words_of(command.display), "{}", summary(books.totals(), print.lookahead().effort()));
  }
  return tell_ending(result, command.display);
}

}  // namespace unicursal::host
