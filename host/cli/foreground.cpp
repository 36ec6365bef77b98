#include "host/cli/foreground.hpp"

#include <nlohmann/json.hpp>

#include "host/cli/console.hpp"
#include "host/cli/display.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/session_json.hpp"

namespace unicursal::host {

StreamResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                  const StreamSettings& settings) {
  Display display(options.json ? DisplayForm::json : DisplayForm::words);
  const auto observer = [&](const Session& session, const SessionEvent& event) {
    display.show(session, event);
  };
  const auto console = [&](Session& session, const std::string& words) {
    if (const std::string answer = obey(session, words); !answer.empty()) display.answer(answer);
  };
  return stream(port, source, observer, settings, console);
}

StreamResult stream_with_progress(Print& print, const DisplayOptions& options) {
  return stream_with_progress(print.take_port(), print.source(), options, print.settings());
}

void show_how_to_resume(Spool& spool, const StreamResult& result) {
  if (const auto problem = spool.journal().problem()) show(stderr, "warning: {}\n", *problem);
  if (result.ending == Ending::completed || !result.begun) return;
  show(stderr, "to resume this print: unicursal resume {}\n", spool.folder().filename().string());
}

Exit show_ending(const StreamResult& result, const DisplayOptions& display) {
  if (display.json) {
    nlohmann::json end = {{"event", "end"}, {"ended", name(result.ending)}, {"parked", result.parked}};
    if (!result.reason.empty()) end["reason"] = result.reason;
    show(stdout, "{}\n", end.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (result.ending == Ending::stopped) {
    show(stdout, "stopped by the user; the printer is {}\n",
         result.parked ? "parked and cooling" : "cooling");
  }
  switch (result.ending) {
    case Ending::completed:
      return Exit::success;
    case Ending::stopped:
      return Exit::stopped;
    case Ending::failed:
      break;
  }
  return Exit::failed;
}

std::FILE* message_stream(const DisplayOptions& display) {
  return display.json ? stderr : stdout;
}

}  // namespace unicursal::host
