#include "host/cli/daemon_feeding.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "host/cli/terminal_look.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/engine/session_types.hpp"
#include "host/loop/print_signals.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr auto look_again = std::chrono::milliseconds(250);
constexpr auto any_port = "auto";

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

void order(const Client& client, const char* what, const json& body = json::object()) {
  accepted(client.ask("POST", std::string("/api/printer/") + what, body));
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

[[noreturn]] void fail(const json& printer) {
  throw PrintError(printer.value("problem", "the daemon's printer is not connected any more") +
                   "; see `unicursal status`");
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

/// Returns how it ended, as the daemon says it.
std::string feed_to_end(const Client& client, NotedSignals& signals) {
  FeedingLine line;
  for (;;) {
    const json printer = printer_of(client);
    if (printer.contains("fed")) {
      if (printer["fed"] == "failed") fail(printer);
      return printer["fed"];
    }
    if (printer.value("connection", "") != "open") fail(printer);
    line.update(printer);
    if (asked_to_end(signals)) order(client, "cancel");
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
  order(client, "feed", words_for(wanted));
  const std::string ended = feed_to_end(client, signals);
  if (!connected) order(client, "disconnect");
  return ended == "completed" ? Exit::success : Exit::stopped;
}

}  // namespace unicursal::host
