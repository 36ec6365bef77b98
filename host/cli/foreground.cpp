#include "host/cli/foreground.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/display.hpp"
#include "host/cli/status_line.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/cli/typed_line.hpp"
#include "host/engine/reconnecting.hpp"
#include "host/engine/session_json.hpp"
#include "host/feeding/cool_when_back.hpp"
#include "host/history/keep.hpp"
#include "host/link/find_port.hpp"
#include "host/loop/print_signals.hpp"

namespace unicursal::host {

namespace {

std::string dump(const nlohmann::json& event) {
  return event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

DisplayForm form_of(const DisplayOptions& options) {
  if (options.json) return DisplayForm::json;
  return options.quiet ? DisplayForm::urgent_words : DisplayForm::words;
}

/// Streams as long as it takes, with one display.
class Shown {
 public:
  Shown(const DisplayOptions& options, StatusLook look) : display_(form_of(options), std::move(look)) {}

  ForegroundResult stream(int port, Source& source, const StreamSettings& settings) {
    ForegroundResult result;
    const auto observer = [this, &result](const Session& session, const SessionEvent& event) {
      display_.show(session, event);
      if (result.foretold && event.kind != SessionEvent::Kind::state) return;
      const SessionStatus status = session.status();
      result.seconds = status.elapsed;
      result.reason = status.reason;
      result.warnings = status.warnings;
      if (!result.foretold && status.left) result.foretold = status.elapsed + *status.left;
    };
    const auto console = [this](Session& session, std::string_view bytes) {
      for (const std::string& words : line_.take(bytes)) {
        display_.typing({});
        display_.typed(words);
        if (const std::string answer = obey(session, words); !answer.empty()) display_.answer(answer);
      }
      display_.typing(line_.text());
    };
    result.stream = host::stream(port, source, observer, settings, console);
    return result;
  }

  void notice(const std::string& sentence) { display_.notice(sentence); }

 private:
  Display display_;
  TypedLine line_;
};

/// A mixture without a name of its own is called by its shares (gcode::shares_text()).
std::optional<gcode::Mixture> mixture_of_shares(const std::string& text) {
  std::vector<double> shares;
  std::istringstream stream(text);
  std::string between = ":";
  while (shares.size() < gcode::most_feeders && between == ":") {
    double share = 0;
    if (!(stream >> share)) return std::nullopt;
    shares.push_back(share);
    if (!(stream >> between)) break;
  }
  if (!stream.eof()) return std::nullopt;
  try {
    return gcode::Mixture(gcode::Shares::of(shares));
  } catch (const core::DataError&) {
    return std::nullopt;
  }
}

/// Returns an empty text if the print can go on; otherwise why not.
std::string wait_for(Print& print) {
  try {
    return reconnect_in_foreground(print) ? "" : "it did not come back";
  } catch (const core::DataError& error) {
    return error.what();
  }
}

/// What a user reads whose cable was pulled.
std::string outcome_of(const Cooling& cooling) {
  switch (cooling.ending) {
    case Cooling::Ending::cooled:
      return "the printer is back, and it cools; begin again";
    case Cooling::Ending::time_over:
      return "the printer did not come back: switch it off by its own switch";
    case Cooling::Ending::gave_up:
      break;
  }
  return cooling.reason + "; it may still be hot: switch the printer off by its own switch";
}

/// The user has stopped the print, and its connection was lost before the heaters were off.
StreamResult cool_stopped(const Print& print, StreamResult result, Shown& shown) {
  shown.notice(fmt::format("{}; the heaters are switched off when it is back, for up to {} minutes",
                           result.reason, reconnecting_patience.count()));
  const Cooling cooling =
      cool_when_back(print.port_when_back(), print.job().profile.baud, print.settings().link);
  if (cooling.ending == Cooling::Ending::cooled) {
    result.ending = Ending::stopped;
    result.reason.clear();
  } else {
    result.reason += "; " + outcome_of(cooling);
  }
  return result;
}

}  // namespace

StatusLook look_for(const Job& job) {
  StatusLook look;
  look.colour_of = [materials = job.print.materials, filaments = job.profile.filaments.colours()](
                       const std::string& name) -> std::optional<picture::Colour> {
    const auto named = std::find_if(materials.begin(), materials.end(),
                                    [&](const gcode::Material& material) { return material.name == name; });
    if (named != materials.end()) return picture::colour_of(named->mixture.shares(), filaments);
    const auto mixture = mixture_of_shares(name);
    if (!mixture || mixture->feeders() > filaments.size()) return std::nullopt;
    return picture::colour_of(mixture->shares(), filaments);
  };
  return look;
}

ForegroundResult stream_with_progress(int port, Source& source, const DisplayOptions& options,
                                      const StreamSettings& settings, StatusLook look) {
  return Shown(options, std::move(look)).stream(port, source, settings);
}

ForegroundResult stream_with_progress(Print& print, const DisplayOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  Shown shown(options, look_for(print.job()));
  NotedSignals signals;
  StreamSettings settings = print.settings();
  settings.stop_came = [&signals] { return signals.came(); };
  ForegroundResult result = shown.stream(print.take_port(), print.source(), settings);
  while (may_reconnect(result.stream)) {
    bool stopped = signals.came() || result.stream.stop != StopAsked::no;
    std::string problem = "it was stopped";
    if (!stopped) {
      shown.notice(fmt::format("{}; the print goes on when it is back, for up to {} minutes",
                               result.stream.reason, reconnecting_patience.count()));
      problem = wait_for(print);
      stopped = signals.came();
    }
    if (stopped) {
      if (problem.empty()) ::close(print.take_port());
      result.stream = cool_stopped(print, std::move(result.stream), shown);
      break;
    }
    if (!problem.empty()) {
      result.stream.reason += "; " + problem;
      break;
    }
    shown.notice("the printer is back");
    settings = print.settings();
    settings.stop_came = [&signals] { return signals.came(); };
    ForegroundResult next = shown.stream(print.take_port(), print.source(), settings);
    result.stream = as_failure(std::move(next.stream));
    result.reason = std::move(next.reason);
    result.warnings = std::move(next.warnings);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

bool stream_or_cool(const std::string& port, const Profile& profile, Source& source, StreamSettings settings,
                    StatusLook look) {
  const int descriptor = open_port(port, profile.baud, settings.link);
  // The device's own name may be another one, or another printer's, when it is plugged in again.
  const std::string device = device_of(descriptor), stable_name = stable_name_of(device);
  const NotedSignals signals;  // none kills the program while the printer is hot
  const StreamResult result = stream_with_progress(descriptor, source, {}, settings, std::move(look)).stream;
  if (result.unfit) throw PrinterUnfit(result.reason);
  if (may_reconnect(result)) {
    show(stderr, "{}; plug it in again within {} minutes, and its heaters are switched off\n", result.reason,
         reconnecting_patience.count());
    const std::string known = port == "auto" ? device : port;
    throw PrintError(
        outcome_of(cool_when_back(stable_name.empty() ? known : stable_name, profile.baud, settings.link)));
  }
  if (result.ending == Ending::failed) throw PrintError(result.reason);
  return result.ending == Ending::stopped;
}

void note_in_history(Print& print, const ForegroundResult& result) {
  const std::string& why = result.stream.reason.empty() ? result.reason : result.stream.reason;
  const EndedSession ended{{}, why, result.seconds, result.foretold, result.warnings};
  for (const std::string& note : keep_in_history(print.spool(), print.production(), ended))
    show(stderr, "warning: {}\n", note);
}

void show_done(const ForegroundResult& result, const DisplayOptions& display) {
  const auto now = std::chrono::system_clock::now();
  std::string line =
      fmt::format("done at {}, after {}", time_of_day(now, now), rough_duration(result.seconds));
  if (result.foretold) line += fmt::format("; {} had been foretold", rough_duration(*result.foretold));
  show(message_stream(display), "{}\n", line);
}

void show_how_to_resume(Spool& spool, const StreamResult& result) {
  if (const auto problem = spool.journal().problem()) show(stderr, "warning: {}\n", *problem);
  if (result.ending == Ending::completed || !result.begun) return;
  show(stderr, "to resume this print: `unicursal resume {}`\n", spool.folder().filename().string());
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
