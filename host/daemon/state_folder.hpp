// The folder in which a daemon keeps its state, and in which its clients find it:
//
//   lock            held by the one daemon that may use the folder
//   address         "127.0.0.1:8377", while it runs
//   socket          where this user's commands reach it, while it runs (0600)
//   token           the clients' proof of access (0600)
//   metrics-token   opens /metrics only, for a Prometheus that must not steer printers (0600)
//   identity        by which Home Assistant knows the daemon again
//   keys.json       keys of single programs (keys.hpp; 0600)
//   preferences.json   what the page's users have chosen (preferences.hpp; 0600)
//   queue.json      the jobs (queue.hpp)
//   printing        the print that is going on (interrupted.hpp)
//   files/          uploads (job_files.hpp)
//   dry-runs/       what clients have tried (dry_runs.hpp)
//
// Only its owner can read it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "host/files/descriptor.hpp"

namespace unicursal::host {

/// The folder or a file in it cannot be used, or no daemon is running there.
class DaemonError : public core::DataError {
 public:
  using DataError::DataError;
};

class StateFolder {
 public:
  /// Makes the folder if it is missing and takes the lock. Throws DaemonError, for example if another daemon
  /// holds the lock.
  explicit StateFolder(std::filesystem::path folder);
  ~StateFolder();
  StateFolder(const StateFolder&) = delete;
  StateFolder& operator=(const StateFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// The text of a secret, which is made if it is missing. Throws DaemonError if others may read it.
  std::string secret(const std::string& name) const;
  /// A new text for a secret; the old one is lost. Throws DaemonError.
  std::string renewed(const std::string& name) const;
  /// Writes the address for people and programs; the destructor removes it, and the socket.
  void write_address(const std::string& address) const;
  void remove_address() const noexcept;

 private:
  std::filesystem::path folder_;
  Descriptor lock_;
};

/// $XDG_STATE_HOME/unicursal/daemon, or ~/.local/state/unicursal/daemon.
std::filesystem::path default_state_folder();

/// Writes a file of the folder, readable by its owner only, whole or not at all (whole_file.hpp). Throws
/// DaemonError.
void write_state(const std::filesystem::path& file, const std::string& text);

/// The first line of a file; absent if the file is missing or empty.
std::optional<std::string> read_line(const std::filesystem::path& file);

}  // namespace unicursal::host
