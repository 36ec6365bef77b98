#include "host/cli/foreground.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/display.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/engine/reconnecting.hpp"
#include "host/engine/session_json.hpp"

namespace unicursal::host {

namespace {

std::string dump(const nlohmann::json& event) {
  return event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Streams as long as it takes, with one display.
class Shown {
 public:
  explicit Shown(const DisplayOptions& options)
      : display_(options.json ? DisplayForm::json : DisplayForm::words) {}

  StreamResult stream(int port, Source& source, const StreamSettings& settings) {
    const auto observer = [this](const Session& session, const SessionEvent& event) {
      display_.show(session, event);
    };
    const auto console = [this](Session& session, const std::string& words) {
      if (const std::string answer = obey(session, words); !answer.empty()) display_.answer(answer);
    };
    return host::stream(port, source, observer, settings, console);
  }

  void notice(const std::string& sentence) { display_.notice(sentence); }

 private:
  Display display_;
};

/// Returns whether the print can go on; otherwise the reason of its end says why.
bool is_back(Print& print, StreamResult& result) {
  try {
    if (reconnect_in_foreground(print)) return true;
    result.reason += "; it did not come back";
  } catch (const core::DataError& error) {
    result.reason += std::string("; ") + error.what();
  }
  return false;
}

}  // namespace

StreamResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                  const StreamSettings& settings) {
  return Shown(options).stream(port, source, settings);
}

StreamResult stream_with_progress(Print& print, const DisplayOptions& options) {
  Shown shown(options);
  StreamResult result = shown.stream(print.take_port(), print.source(), print.settings());
  while (may_reconnect(result)) {
    shown.notice(fmt::format("{}; the print goes on when it is back, for up to {} minutes", result.reason,
                             reconnecting_patience.count()));
    if (!is_back(print, result)) break;
    shown.notice("the printer is back");
    result = as_failure(shown.stream(print.take_port(), print.source(), print.settings()));
  }
  return result;
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
    show_json_text(stdout, dump(end));
  } else if (result.ending == Ending::stopped) {
    show(stdout, "stopped; the printer is {}\n", result.parked ? "parked and cooling" : "cooling");
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
