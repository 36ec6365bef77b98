// The daemon as a process: its loop, address and signals, and its messages to systemd.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/daemon/daemon.hpp"

namespace unicursal::host {

struct ServeOptions {
  DaemonOptions daemon;
  std::string listen = "127.0.0.1:8377";  ///< address and port; port 0: any free one
  std::vector<std::string> names;         ///< further host names that clients may use
  bool no_token = false;                  ///< everyone on this computer may steer the printer
  bool lan = false;                       ///< clients may use this computer's present addresses and its name
  std::optional<std::filesystem::path> web_folder;  ///< the page's files; absent: those of the program
};

/// Runs until SIGTERM, SIGINT, SIGQUIT or SIGHUP. The first signal parks and cools the current print, a
/// second one stops the printer at once. `ready` is called with the address once clients may connect;
/// with `lan`, that is one by which others reach this computer. Throws
/// core::DataError before that.
void serve(const ServeOptions& options, const std::function<void(const std::string& address)>& ready);

}  // namespace unicursal::host
