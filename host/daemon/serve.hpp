// The daemon as a process: its loop, its address, its signals, and what systemd hears of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/daemon/daemon.hpp"

namespace unicursal::host {

struct ServeOptions {
  DaemonOptions daemon;
  std::string listen = "127.0.0.1:8377";  ///< address and port; port 0: any that is free
  std::vector<std::string> names;         ///< other names of this computer by which clients may come
  bool no_token = false;                  ///< everyone on this computer may steer the printer
};

/// Until SIGTERM or SIGINT, which parks and cools a print that is going on and waits for it; another one
/// stops the printer at once. `ready`: told the address when clients may come. Throws core::DataError before
/// that.
void serve(const ServeOptions& options, const std::function<void(const std::string& address)>& ready);

}  // namespace unicursal::host
