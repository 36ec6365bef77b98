#include "host/cli/daemon_feeding.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/error.hpp"
#include "host/cli/terminal_look.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/session_types.hpp"
#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr auto look_again = std::chrono::milliseconds(250);
constexpr int looks_after_feeding = 8;  ///< without any news of it, until it is given up: 2 s
constexpr int looks_before_feeding =
    240;  ///< the same, while the daemon's other commands may come first: 60 s
constexpr auto any_port = "auto";
constexpr auto perhaps_hot = "; the nozzle may still be hot: look at `unicursal status`";

bool same_device(const std::string& one, const std::string& other) {
  std::error_code error;
  return one == other || std::filesystem::equivalent(one, other, error);
}

/// On a terminal one line that is rewritten; elsewhere a line for each new activity.
class FeedingLine {
 public:
  FeedingLine() : rewrites_(look_of(STDERR_FILENO).rewrites) {}
  ~FeedingLine() {
    if (rewrites_) erase_line(stderr);
  }
  FeedingLine(const FeedingLine&) = delete;
  FeedingLine& operator=(const FeedingLine&) = delete;

  void update(const json& printer) {
    const std::string doing = printer.value("doing", "");
    if (doing.empty()) return;
    const json nozzle = printer.value("nozzle", json::object());
    std::string heat;
    if (nozzle.contains("actual_c"))
      heat = fmt::format(", nozzle {:.0f}/{:.0f} °C", nozzle["actual_c"].get<double>(),
                         nozzle.value("target_c", 0.0));
    if (rewrites_) {
      erase_line(stderr);
      show(stderr, "{}{}", doing, heat);
    } else if (doing != shown_) {
      show(stderr, "{}{}\n", doing, heat);
    }
    shown_ = doing;
  }

 private:
  const bool rewrites_;
  std::string shown_;
};

/// After a moment.
bool asked_to_end(NotedSignals& signals) {
  std::this_thread::sleep_for(look_again);
  return signals.came();
}

json printer_of(const Client& client) {
  return accepted(client.ask("GET", "/api/printer"));
}

void order(const Client& client, const char* what) {
  accepted(client.ask("POST", std::string("/api/printer/") + what, json::object()));
}

json words_for(const FeedingOrder& order) {
  const char* action = order.kind == FeedingKind::load    ? "load"
                       : order.kind == FeedingKind::purge ? "purge"
                                                          : "unload";
  json body = {{"action", action}};
  if (order.feeder) body["feeder"] = *order.feeder + 1;
  if (order.length) body["length"] = *order.length;
  return body;
}

std::string problem_of(const json& printer) {
  return printer.value("problem", "the daemon's printer is not connected any more");
}

[[noreturn]] void fail(const json& printer) {
  throw PrintError(problem_of(printer) + "; see `unicursal status`");
}

/// Returns false if somebody wants to end it before.
bool connect(const Client& client, NotedSignals& signals) {
  order(client, "connect");
  for (;;) {
    const json printer = printer_of(client);
    const std::string connection = printer.value("connection", "");
    if (connection == "open") return true;
    if (connection != "connecting") fail(printer);
    if (asked_to_end(signals)) return false;
  }
}

/// An error is a PrintError, since filament may be moving.
json while_feeding(const std::function<json()>& ask) {
  try {
    return ask();
  } catch (const core::DataError& error) {
    throw PrintError(error.problem() + perhaps_hot);
  }
}

void cancel(const Client& client) {
  while_feeding([&] { return accepted(client.ask("POST", "/api/printer/cancel", json::object())); });
}

/// Only a refusal is a DaemonError; an order without an answer may have been obeyed.
void order_feeding(const Client& client, const FeedingOrder& wanted) {
  Answer answer;
  while_feeding([&] {
    answer = client.ask("POST", "/api/printer/feed", words_for(wanted));
    return json();
  });
  accepted(answer);
}

/// Notices that a daemon has dropped the order without a word, as daemons of older versions do.
class FeedingWatch {
 public:
  /// Returns false if it is to be given up.
  bool goes_on(const json& printer) {
    const std::string action = printer.value("action", "");
    begun_ = begun_ || action == "feeding";
    looks_ = action == "feeding" || action == "homing" ? 0 : looks_ + 1;
    return looks_ < (begun_ ? looks_after_feeding : looks_before_feeding);
  }

 private:
  bool begun_ = false;
  int looks_ = 0;  ///< in a row, in which it did not feed
};

/// Returns how it ended, as the daemon says it.
std::string feed_to_end(const Client& client, NotedSignals& signals) {
  FeedingLine line;
  FeedingWatch watch;
  for (bool cancelled = false;;) {
    const json printer = while_feeding([&] { return printer_of(client); });
    if (printer.contains("fed")) {
      if (printer["fed"] == "failed") fail(printer);
      return printer["fed"];
    }
    if (printer.value("connection", "") != "open") throw PrintError(problem_of(printer) + perhaps_hot);
    if (!watch.goes_on(printer)) {
      cancel(client);  // or it would begin later
      throw PrintError(std::string("the daemon does not say how the feeding has ended") + perhaps_hot);
    }
    line.update(printer);
    if (!asked_to_end(signals)) continue;
    if (cancelled)
      throw PrintError(
          "the command ends before the daemon has stopped; the printer may still be feeding: look at "
          "`unicursal status`");
    cancel(client);
    cancelled = true;
  }
}

/// Closes the connection that this command has opened. One that was lost is left alone, since the daemon
/// looks for a printer that may be hot.
void give_back(const Client& client, bool feeds_for_others) {
  try {
    const json printer = printer_of(client);
    const bool others = feeds_for_others && printer.value("action", "") == "feeding";
    if (printer.value("connection", "") == "open" && !others) order(client, "disconnect");
  } catch (const core::DataError&) {
    // A print has the printer now, or the daemon has gone.
  }
}

}  // namespace

std::optional<Client> own_daemon(const DaemonAccess& access) {
  try {
    return Client::find(access.state ? *access.state : default_state_folder());
  } catch (const core::DataError&) {
    return std::nullopt;  // the home folder is unknown
  }
}

std::optional<Client> daemon_with_port(const DaemonAccess& access, const std::string& port,
                                       const std::string& printer) {
  std::optional<Client> client = own_daemon(access);
  if (!client) return std::nullopt;
  const json known = printer_of(*client);
  const std::string its_port = known.value("port", "");
  if (its_port.empty()) return std::nullopt;
  const bool searched = port == any_port || its_port == any_port;
  const bool same = searched ? known.value("name", "") == printer : same_device(port, its_port);
  if (!same) return std::nullopt;
  return client;
}

Profile profile_of(const Client& client) {
  const json profile = accepted(client.ask("GET", "/api/profile"));
  return profile_in(profile.value("toml", ""), profile.value("file", "the daemon's profile"));
}

Exit feed_by_daemon(const Client& client, const FeedingOrder& wanted) {
  NotedSignals signals;
  const bool connected = printer_of(client).value("connection", "") != "closed";
  if (!connected && !connect(client, signals)) {
    order(client, "disconnect");
    return Exit::stopped;
  }
  try {
    order_feeding(client, wanted);
    const std::string ended = feed_to_end(client, signals);
    if (!connected) give_back(client, false);
    return ended == "completed" ? Exit::success : Exit::stopped;
  } catch (const core::DataError&) {
    if (!connected) give_back(client, true);
    throw;
  } catch (const PrintError&) {
    if (!connected) give_back(client, false);
    throw;
  }
}

}  // namespace unicursal::host
