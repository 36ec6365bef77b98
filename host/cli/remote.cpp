// The commands that talk to a daemon: status, start, pause, resume, cancel, stop, queue.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/text/file_bytes.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/show.hpp"
#include "host/daemon/client.hpp"
#include "host/daemon/job_files.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/job/load_job.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

fs::path folder_of(const RemoteCommand& command) {
  return command.state ? *command.state : default_state_folder();
}

Client connected(const RemoteCommand& command) {
  if (auto client = Client::find(folder_of(command))) return std::move(*client);
  throw DaemonError(folder_of(command).string(), "", "no daemon runs with this state folder",
                    "start one with `unicursal serve`, or name its folder with --state");
}

void show_json(const json& body) {
  show(stdout, "{}\n", body.dump(1, ' ', false, json::error_handler_t::replace));
}

/// The answer's body, if the daemon has obeyed; its own sentence otherwise.
json obeyed(const Answer& answer) {
  if (answer.status < 400) return answer.body;
  throw DaemonError("", "", answer.body.value("error", "the daemon refuses"), "see `unicursal status`");
}

std::string heater_words(const json& print, const char* which) {
  const json heater = print.value(which, json::object());
  if (!heater.contains("actual_c")) return "";
  return fmt::format(", {} {:.0f} of {:.0f} °C", which, heater["actual_c"].get<double>(),
                     heater.value("target_c", 0.0));
}

std::string job_words(const json& job) {
  std::string words =
      fmt::format("{} {}: {}", job.value("id", 0), job.value("job", ""), job.value("state", ""));
  if (job.contains("layers"))
    words += fmt::format(", layers {} to {}", job["layers"][0].get<int>(), job["layers"][1].get<int>());
  if (job.contains("reason")) words += " (" + job["reason"].get<std::string>() + ")";
  return words;
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
  show(stdout, "{}{}{}\n", line, heater_words(print, "nozzle"), heater_words(print, "bed"));
  if (print.contains("mixture")) show(stdout, "mixture: {}\n", print["mixture"].get<std::string>());
  for (const json& warning : print.value("warnings", json::array()))
    show(stdout, "note: {}\n", warning.get<std::string>());
}

void show_status(const json& status) {
  if (status.contains("job")) show(stdout, "job {}\n", job_words(status["job"]));
  if (status.contains("print")) show_print(status["print"]);
  if (!status.contains("job")) show(stdout, "idle; {} waiting\n", status.value("waiting", 0));
  if (!status.contains("job") && status.contains("last"))
    show(stdout, "last: {}\n", job_words(status["last"].value("job", json::object())));
  if (status.contains("problem")) show(stdout, "note: {}\n", status["problem"].get<std::string>());
}

/// Reading the part may still fail; whoever starts it wants to know.
json started(const Client& client, std::uint64_t id) {
  constexpr auto look_again = std::chrono::milliseconds(200);
  const std::string path = fmt::format("/api/jobs/{}", id);
  json job = obeyed(client.ask("GET", path));
  while (job.value("state", "") == "preparing" || job.value("state", "") == "queued") {
    std::this_thread::sleep_for(look_again);
    job = obeyed(client.ask("GET", path));
  }
  return job;
}

Exit start(const RemoteCommand& command, const Client& client) {
  const json body = command.id ? json{{"id", *command.id}} : json::object();
  const json begun = obeyed(client.ask("POST", "/api/print/start", body));
  const json job = started(client, begun.at("id").get<std::uint64_t>());
  if (command.json)
    show_json(job);
  else
    show(stdout, "job {}\n", job_words(job));
  return job.value("state", "") == "failed" ? Exit::failed : Exit::success;
}

/// What a job file names lies beside it, or it could not be sent.
void check_beside(const fs::path& job, const fs::path& file) {
  std::error_code error;
  if (fs::equivalent(fs::absolute(job).parent_path(), fs::absolute(file).parent_path(), error) &&
      is_plain_name(file.filename().string()))
    return;
  throw DaemonError(job.string(), "", "refers to " + file.string() + ", which cannot be sent along",
                    "put everything into one folder, in files with plain names; or let the daemon know the "
                    "folder with --jobs");
}

/// One that no job in the queue needs any more.
std::string free_folder(const Client& client, const std::string& name) {
  const json jobs = obeyed(client.ask("GET", "/api/jobs")).at("jobs");
  const auto needed = [&](const std::string& folder) {
    return std::any_of(jobs.begin(), jobs.end(), [&](const json& job) {
      const std::string state = job.at("state");
      const bool open = state == "queued" || state == "preparing" || state == "printing";
      return open && job.at("job").get<std::string>().starts_with("upload:" + folder + "/");
    });
  };
  std::string folder = name;
  for (int i = 2; needed(folder); ++i) folder = fmt::format("{}-{}", name, i);
  return folder;
}

std::string upload(const Client& client, const fs::path& file) {
  const std::vector<fs::path> files = files_of(load_job(file)).all();
  for (const fs::path& one : files) check_beside(file, one);
  const std::string folder = free_folder(client, file.stem().string());
  for (const fs::path& one : files) {
    const std::string path = fmt::format("/api/files/{}/{}", folder, one.filename().string());
    obeyed(client.send_file(path, core::file_bytes(one)));
  }
  return fmt::format("upload:{}/{}", folder, file.filename().string());
}

Exit list(const Client& client, const QueueCommand& command) {
  const json answer = obeyed(client.ask("GET", command.list_jobs ? "/api/files" : "/api/jobs"));
  if (command.remote.json) {
    show_json(answer);
    return Exit::success;
  }
  for (const json& job : answer.at("jobs"))
    show(stdout, "{}\n", job.is_string() ? job.get<std::string>() : job_words(job));
  return Exit::success;
}

}  // namespace

Exit remote(const RemoteCommand& command) {
  const Client client = connected(command);
  if (command.word == "start") return start(command, client);
  const json answer = command.word == "status"
                          ? obeyed(client.ask("GET", "/api/status"))
                          : obeyed(client.ask("POST", "/api/print/" + command.word, json::object()));
  if (command.json)
    show_json(answer);
  else
    show_status(answer);
  return Exit::success;
}

Exit set(const SetCommand& command) {
  if (!command.speed && !command.flow && !command.nozzle && !command.bed)
    throw DaemonError("", "set", "changes nothing", "say --speed, --flow, --nozzle or --bed with a number");
  const Client client = connected(command.remote);
  json heat = json::object();
  if (command.nozzle) heat["nozzle_c"] = *command.nozzle;
  if (command.bed) heat["bed_c"] = *command.bed;
  json status;
  if (!heat.empty()) status = obeyed(client.ask("POST", "/api/temperature", heat));
  if (command.flow) status = obeyed(client.ask("POST", "/api/flow", {{"percent", *command.flow}}));
  if (command.speed) status = obeyed(client.ask("POST", "/api/speed", {{"percent", *command.speed}}));
  if (command.remote.json)
    show_json(status);
  else
    show_status(status);
  return Exit::success;
}

Exit queue(const QueueCommand& command) {
  const Client client = connected(command.remote);
  if (command.remove) {
    obeyed(client.ask("DELETE", fmt::format("/api/jobs/{}", *command.remove)));
    return Exit::success;
  }
  if (!command.add && !command.upload) return list(client, command);
  json body = {{"job", command.upload ? upload(client, *command.upload) : *command.add}};
  if (command.layers) body["layers"] = {command.layers->first, command.layers->last};
  const json answer = obeyed(client.ask("POST", "/api/jobs", body));
  if (command.remote.json)
    show_json(answer);
  else
    show(stdout, "{} {}\n", answer.at("id").get<std::uint64_t>(), body["job"].get<std::string>());
  return Exit::success;
}

bool daemon_prints(const RemoteCommand& command) {
  try {
    const auto client = Client::find(folder_of(command));
    return client && obeyed(client->ask("GET", "/api/status")).contains("print");
  } catch (const core::DataError&) {
    return false;  // it is gone and has left its address behind, or there is no home for it
  }
}

}  // namespace unicursal::host
