#include <fmt/format.h>

#include <algorithm>

#include "core/model/read_part.hpp"
#include "core/text/file_bytes.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/command.hpp"
#include "host/cli/daemon_access.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/job/load_job.hpp"
#include "host/job/sliced_file.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Throws DaemonError unless the file lies in the folder of the job: only such files can be sent.
void check_beside(const fs::path& job, const fs::path& file) {
  std::error_code error;
  if (fs::equivalent(fs::absolute(job).parent_path(), fs::absolute(file).parent_path(), error) &&
      is_plain_name(file.filename().string()))
    return;
  throw DaemonError(job.string(), "", "refers to " + file.string() + ", which cannot be sent along",
                    "put all files of the job into one folder and give them plain names, or start the daemon "
                    "with the job's folder as --jobs");
}

/// Returns a folder name that no job of the queue uses.
std::string free_folder(const Client& client, const std::string& name) {
  const json jobs = accepted(client.ask("GET", "/api/jobs")).at("jobs");
  const auto used = [&](const std::string& folder) {
    return std::any_of(jobs.begin(), jobs.end(), [&](const json& job) {
      const std::string state = job.at("state");
      const bool open = state == "queued" || state == "preparing" || state == "printing";
      return open && job.at("job").get<std::string>().starts_with("upload:" + folder + "/");
    });
  };
  std::string folder = name;
  for (int i = 2; used(folder); ++i) folder = fmt::format("{}-{}", name, i);
  return folder;
}

/// The job with the files that it names, or the model with those that belong to it. The daemon's profile
/// decides how a model is printed.
std::vector<fs::path> files_to_send(const fs::path& file) {
  if (is_sliced_file(file)) return {file};
  if (!core::is_model_file(file)) return files_of(load_job(file)).all();
  std::vector<fs::path> files = core::companion_files(file);
  files.insert(files.begin(), file);
  return files;
}

/// Sends the job and its files. Returns the name of the job in the daemon.
std::string upload(const Client& client, const fs::path& file) {
  const std::vector<fs::path> files = files_to_send(file);
  for (const fs::path& one : files) check_beside(file, one);
  const std::string folder = free_folder(client, file.stem().string());
  for (const fs::path& one : files) {
    const std::string path = fmt::format("/api/files/{}/{}", folder, one.filename().string());
    accepted(client.send_file(path, core::file_bytes(one)));
  }
  return fmt::format("upload:{}/{}", folder, file.filename().string());
}

class QueueCommand final : public Command {
 public:
  CLI::App& declare(CLI::App& program) override;
  Exit run() override;

 private:
  Exit list(const Client& client) const;

  std::optional<std::string> add_;
  std::optional<fs::path> upload_;
  std::optional<LayerRange> layers_;
  std::optional<std::uint64_t> remove_;
  bool list_jobs_ = false, bed_clear_ = false;
  DaemonAccess access_;
};

CLI::App& QueueCommand::declare(CLI::App& program) {
  CLI::App& app = add_command(program, "queue", "Daemon", "List, add and remove jobs of the daemon's queue.",
                              "unicursal queue --add leaf.toml");
  add_note(app, "Without options the command lists the queue.");
  app.add_flag("--jobs", list_jobs_, "List the jobs in the daemon's folders, which can be added.");
  CLI::Option& add = add_value(app, "--add", add_, "JOB", "Add a job or a model from the daemon's folders.");
  add_value(app, "--upload", upload_, "JOB",
            "Send a job of your own with the files that it names, or a model, and add it.")
      .excludes(&add);
  declare_layers(app, layers_, "Print only these layers of the job: A to B, counted from 0, both included.");
  add_value(app, "--remove", remove_, "NUMBER", "Remove the job of this number.")
      .check(integer_between(0, std::numeric_limits<std::uint64_t>::max()));
  app.add_flag(
      "--bed-clear", bed_clear_,
      "Confirm that the bed is clear: with `serve --start-uploads`, a file that a slicer has sent, or "
      "sends, to be printed starts.");
  access_.declare(app);
  return app;
}

Exit QueueCommand::run() {
  const Client client = access_.connect();
  if (bed_clear_) {
    accepted(client.ask("POST", "/api/bed", {{"clear", true}}));
    return Exit::success;
  }
  if (remove_) {
    accepted(client.ask("DELETE", fmt::format("/api/jobs/{}", *remove_)));
    return Exit::success;
  }
  if (!add_ && !upload_) return list(client);
  json body = {{"job", upload_ ? upload(client, *upload_) : *add_}};
  if (layers_) body["layers"] = {layers_->first, layers_->last};
  const json answer = accepted(client.ask("POST", "/api/jobs", body));
  if (access_.json)
    show_json(answer);
  else
    show(stdout, "{} {}\n", answer.at("id").get<std::uint64_t>(), body["job"].get<std::string>());
  return Exit::success;
}

Exit QueueCommand::list(const Client& client) const {
  const json answer = accepted(client.ask("GET", list_jobs_ ? "/api/files" : "/api/jobs"));
  if (access_.json) {
    show_json(answer);
    return Exit::success;
  }
  const json& jobs = answer.at("jobs");
  if (jobs.empty())
    show(stdout, "{}\n",
         list_jobs_ ? "the daemon's folders hold no jobs; `unicursal queue --upload JOB` sends one"
                    : "the queue is empty; `unicursal queue --add JOB` adds a job");
  for (const json& job : jobs) show(stdout, "{}\n", job.is_string() ? job.get<std::string>() : job_text(job));
  return Exit::success;
}

}  // namespace

std::unique_ptr<Command> make_queue() {
  return std::make_unique<QueueCommand>();
}

}  // namespace unicursal::host
