// Who may use the daemon: clients that know the token and address this computer by one of its names. The
// token keeps other users of the computer out. The checks of Host and Origin keep out web pages, which can
// make a browser send requests here and, if their name suddenly resolves to 127.0.0.1 (DNS rebinding), read
// the answers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/http/http_message.hpp"

namespace unicursal::host {

struct AccessRules {
  std::optional<std::string> token;          ///< absent: everyone who can connect is let in
  std::optional<std::string> metrics_token;  ///< opens /metrics and nothing else
  std::vector<std::string> hosts;            ///< allowed values of Host, in lower case: "127.0.0.1:8377"
  /// Further ones that may change, such as this computer's present addresses; empty: none.
  std::function<std::vector<std::string>()> present_hosts = {};
};

/// Throws HttpError 400, 401, 403 or 421. Who has come through the Unix socket needs no proof.
void check_access(const RequestHead& head, const AccessRules& rules);

/// The allowed values of Host for a daemon at this address: the address and localhost, with the port; and
/// `names`. A name with a port is taken as it is; one without also stands for the ports 80 and 443, where a
/// proxy listens.
std::vector<std::string> hosts_for(const std::string& address, unsigned port,
                                   const std::vector<std::string>& names);

/// 256 random bits from the system, in hexadecimal.
std::string random_token();

}  // namespace unicursal::host
