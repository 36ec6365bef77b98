// The folder that a daemon keeps between its lives, and in which its clients find it:
//
//   lock            held by the one daemon that may use the folder
//   address         "127.0.0.1:8377", while it runs
//   token           what its clients prove themselves with (0600)
//   metrics-token   opens /metrics only, for a Prometheus that need not steer printers (0600)
//   queue.json      the jobs (queue.hpp)
//   files/          uploads (job_files.hpp)
//
// Nobody but its owner can look into it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "host/files/descriptor.hpp"

namespace unicursal::host {

/// The folder, or a file in it, cannot be used; or no daemon is there.
class DaemonError : public core::DataError {
 public:
  using DataError::DataError;
};

class StateFolder {
 public:
  /// Makes it where it is missing and takes the lock. Throws DaemonError, among others when another daemon
  /// has it.
  explicit StateFolder(std::filesystem::path folder);
  ~StateFolder();
  StateFolder(const StateFolder&) = delete;
  StateFolder& operator=(const StateFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// The text of a secret, made anew where it is missing. Throws DaemonError when others may read it.
  std::string secret(const std::string& name) const;
  /// Where clients find the daemon; taken away by the destructor.
  void tell_address(const std::string& address) const;

 private:
  std::filesystem::path folder_;
  Descriptor lock_;
};

/// Beside the prints: $XDG_STATE_HOME/unicursal/daemon, or ~/.local/state/unicursal/daemon.
std::filesystem::path default_state_folder();

/// Writes a file of the folder, readable by its owner only, whole or not at all (whole_file.hpp). Throws
/// DaemonError.
void write_state(const std::filesystem::path& file, const std::string& text);

/// What a client reads; absent when no daemon has written it.
std::optional<std::string> read_line(const std::filesystem::path& file);

}  // namespace unicursal::host
