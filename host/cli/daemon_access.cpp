#include "host/cli/daemon_access.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/files/environment.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

std::string heater_text(const json& print, const char* which) {
  const json heater = print.value(which, json::object());
  if (!heater.contains("actual_c")) return "";
  return fmt::format(", {} {:.0f} of {:.0f} °C", which, heater["actual_c"].get<double>(),
                     heater.value("target_c", 0.0));
}

void show_print(const json& print) {
  std::string line = print.value("state", "");
  if (print.contains("reason")) line += " (" + print["reason"].get<std::string>() + ")";
  line += fmt::format(", layer {} of {}, {:.0f} %", print.value("layer", 0), print.value("layers", 0),
                      print.value("percent", 0.0));
  if (print.contains("left_seconds"))
    line += ", " + duration_words(print["left_seconds"].get<double>()) + " left";
  for (const char* what : {"speed", "flow"}) {
    const double percent = print.value(std::string(what) + "_percent", 100.0);
    if (percent != 100) line += fmt::format(", {} {:.0f} %", what, percent);
  }
  show(stdout, "{}{}{}\n", line, heater_text(print, "nozzle"), heater_text(print, "bed"));
  if (print.contains("mixture")) show(stdout, "mixture: {}\n", print["mixture"].get<std::string>());
  if (print.contains("prompt")) {
    show(stdout, "the printer asks: {}\n", print["prompt"].value("text", ""));
    int number = 0;
    for (const json& answer : print["prompt"].value("answers", json::array()))
      show(stdout, "  unicursal answer {}: {}\n", number++, answer.get<std::string>());
  }
  for (const json& warning : print.value("warnings", json::array()))
    show(stdout, "note: {}\n", warning.get<std::string>());
}

void show_as_text(const json& status) {
  if (status.contains("job")) show(stdout, "job {}\n", job_text(status["job"]));
  if (status.contains("print")) show_print(status["print"]);
  if (!status.contains("job")) show(stdout, "idle; {} waiting\n", status.value("waiting", 0));
  if (!status.contains("job") && status.contains("last"))
    show(stdout, "last job {}\n", job_text(status["last"].value("job", json::object())));
  if (status.contains("interrupted")) {
    const json& print = status["interrupted"];
    show(stdout, "note: the print of job {} ({}) was interrupted: continue it with `unicursal resume`\n",
         print.value("id", 0), print.value("job", ""));
  }
  if (status.contains("problem")) show(stdout, "note: {}\n", status["problem"].get<std::string>());
}

}  // namespace

void DaemonAccess::declare_place(CLI::App& app) {
  constexpr auto group = "Which daemon";
  add_value(app, "--daemon", daemon, "URL",
            "Address of a daemon on another computer, such as http://printer.local:8377. Default: "
            "$UNICURSAL_DAEMON, or the daemon of this user.")
      .group(group);
  add_value(
      app, "--token", token, "TEXT",
      "Token of that daemon, which `unicursal token` shows there. Default: $UNICURSAL_TOKEN, which other "
      "users of this computer cannot see.")
      .group(group);
  declare_state(app, state);
  app.get_option("--state")->group(group);
}

std::optional<std::string> DaemonAccess::remote() const {
  if (daemon) return daemon;
  return state ? std::nullopt : environment("UNICURSAL_DAEMON");
}

void DaemonAccess::declare(CLI::App& app) {
  declare_place(app);
  app.add_flag("--json", json, "Show the daemon's answer as JSON.")->group("Output");
}

Client DaemonAccess::connect() const {
  if (const auto address = remote())
    return Client::at(*address, token ? token : environment("UNICURSAL_TOKEN"));
  if (token)
    throw DaemonError("", "--token", "is for a daemon on another computer", "name that with --daemon");
  const std::filesystem::path folder = state ? *state : default_state_folder();
  if (auto client = Client::find(folder)) return std::move(*client);
  throw DaemonError(folder.string(), "", "no daemon runs with this state folder",
                    "start one with `unicursal serve`, or name its folder with --state");
}

bool DaemonAccess::has_print() const {
  try {
    const auto status = accepted(connect().ask("GET", "/api/status"));
    return status.contains("job") || status.contains("interrupted");
  } catch (const core::DataError&) {
    return false;  // no daemon runs, or it ended without removing its address, or there is no home folder
  }
}

void DaemonAccess::show_status(const nlohmann::json& status) const {
  if (json)
    show_json(status);
  else
    show_as_text(status);
}

void steer(const DaemonAccess& access, const std::string& action) {
  access.show_status(accepted(access.connect().ask("POST", "/api/print/" + action, json::object())));
}

nlohmann::json accepted(const Answer& answer) {
  if (answer.status < 400) return answer.body;
  if (answer.status == 401)
    throw DaemonError(
        "", "", "the daemon does not know this token",
        "give the text that `unicursal token` shows on its computer as --token or $UNICURSAL_TOKEN");
  throw DaemonError("", "", answer.body.value("error", "the daemon refused"), "see `unicursal status`");
}

json begun_job(const Client& client, std::uint64_t id) {
  constexpr auto look_again = std::chrono::milliseconds(200);
  const std::string path = fmt::format("/api/jobs/{}", id);
  json job = accepted(client.ask("GET", path));
  while (job.value("state", "") == "preparing" ||
         (job.value("state", "") == "queued" && !job.contains("reason"))) {
    std::this_thread::sleep_for(look_again);
    job = accepted(client.ask("GET", path));
  }
  return job;
}

void show_json(const nlohmann::json& body) {
  show_json_text(stdout, body.dump(1, ' ', false, json::error_handler_t::replace));
}

std::string job_text(const json& job) {
  std::string text =
      fmt::format("{} {}: {}", job.value("id", 0), job.value("job", ""), job.value("state", ""));
  if (job.contains("layers"))
    text += fmt::format(", layers {} to {}", job["layers"][0].get<int>(), job["layers"][1].get<int>());
  if (job.contains("reason")) text += " (" + job["reason"].get<std::string>() + ")";
  return text;
}

}  // namespace unicursal::host
