// What the commands that steer a daemon share: finding the daemon, and showing its answers.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host/daemon/client.hpp"

namespace unicursal::host {

/// The options of these commands.
struct DaemonAccess {
  std::optional<std::filesystem::path> state;  ///< the daemon's state folder; absent: the user's
  std::optional<std::string> daemon;           ///< address of another computer's; absent: this user's
  std::optional<std::string> token;            ///< of that daemon
  bool json = false;                           ///< show the daemon's answers as they come

  void declare(CLI::App& app);
  /// Only the options that name the daemon.
  void declare_place(CLI::App& app);
  /// The address of another computer's daemon, also from the environment; absent: this user's.
  std::optional<std::string> remote() const;
  /// Throws DaemonError if no daemon runs with this state folder.
  Client connect() const;
  /// Returns whether a daemon runs and has a print, or one that was interrupted. `resume` concerns that then.
  bool has_print() const;
  /// Shows a status of the daemon, as JSON or as text.
  void show_status(const nlohmann::json& status) const;
};

/// Asks the daemon to "pause", "resume", "cancel" or "stop" its print, and shows its new status.
void steer(const DaemonAccess& access, const std::string& action);

/// Returns the answer's body. Throws DaemonError with the daemon's own sentence if it has refused.
nlohmann::json accepted(const Answer& answer);
/// Waits until a daemon has prepared a print, which may still fail, and returns its job. A job that waits
/// again has a reason: its printer is off.
nlohmann::json begun_job(const Client& client, std::uint64_t id);
void show_json(const nlohmann::json& body);
/// Describes a job of the queue: "3 leaf.toml: queued".
std::string job_text(const nlohmann::json& job);

}  // namespace unicursal::host
