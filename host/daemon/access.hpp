// Who may ask: whoever knows the token and comes by a name that this computer goes by. The token keeps other
// users of the computer out; the checks of Host and Origin keep out web pages, which can make a browser send
// requests here, and, by a name of theirs that suddenly means 127.0.0.1 (DNS rebinding), read the answers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/http/http_message.hpp"

namespace unicursal::host {

struct AccessRules {
  std::optional<std::string> token;          ///< absent: everyone who can connect may
  std::optional<std::string> metrics_token;  ///< opens /metrics and nothing else
  std::vector<std::string> hosts;            ///< "127.0.0.1:8377": what Host may say, in lower case
};

/// Throws HttpError 400, 401, 403 or 421.
void check_access(const RequestHead& head, const AccessRules& rules);

/// What Host may say for a daemon at this address: itself, localhost, and `names` of the user's own.
std::vector<std::string> hosts_for(const std::string& address, unsigned port,
                                   const std::vector<std::string>& names);

/// 256 bits from the system, in hexadecimal.
std::string random_token();

}  // namespace unicursal::host
