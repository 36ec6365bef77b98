// Filament moved by a daemon that has the printer, with its progress in the terminal of the command.
#pragma once

#include <optional>
#include <string>

#include "host/cli/daemon_access.hpp"
#include "host/cli/exit.hpp"
#include "host/feeding/feeding.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

/// This user's daemon, if one runs with the state folder.
std::optional<Client> own_daemon(const DaemonAccess& access);

/// The same if it has the printer at this port; where either of
/// them searches for its port, the name of the printer decides.
std::optional<Client> daemon_with_port(const DaemonAccess& access, const std::string& port,
                                       const std::string& printer);

/// Of the daemon's printer. Throws DaemonError if it has none.
Profile profile_of(const Client& client);

/// Connects the printer if the daemon has not, and closes that connection again at the end. Returns when the
/// filament has moved, or stops it after Ctrl-C; a second one does not wait for that. Throws DaemonError if
/// the daemon refuses, and PrintError if it fails, or does not answer any more.
Exit feed_by_daemon(const Client& client, const FeedingOrder& order);

}  // namespace unicursal::host
