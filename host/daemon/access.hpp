// Who may use the daemon: clients that know the token, or a key that was made for them (keys.hpp), and
// address this computer by one of its names. The token keeps other users of the computer out. The checks of
// Host and Origin keep out web pages, which can make a browser send requests here and, if their name suddenly
// resolves to 127.0.0.1 (DNS rebinding), read the answers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/daemon/keys.hpp"
#include "host/daemon/logins.hpp"
#include "host/http/http_message.hpp"

namespace unicursal::host {

struct AccessRules {
  std::optional<std::string> token;          ///< absent: everyone who can connect is let in
  std::optional<std::string> metrics_token;  ///< opens /metrics and nothing else
  std::vector<std::string> hosts;            ///< allowed values of Host, in lower case: "127.0.0.1:8377"
  /// Further ones that may change, such as this computer's present addresses; empty: none.
  std::function<std::vector<std::string>()> present_hosts = {};
  const Keys* keys = nullptr;      ///< those of single programs; null: none
  const Logins* logins = nullptr;  ///< sessions of browsers; null: none
  /// Its name holds the port, since a browser sends a computer's cookies to all of its ports.
  std::string cookie = "unicursal";
};

/// Who asks.
struct Visitor {
  Right right = Right::all;
  std::string name;  ///< of the key; empty: the user of this computer, or who knows the token
};

/// Who has this token or key; absent: nobody.
std::optional<Visitor> visitor_with(const std::string& secret, const AccessRules& rules);
/// Throws HttpError 400, 401, 403 or 421. Who has come through the Unix socket needs no proof. The token or
/// key stands in `Authorization: Bearer` or in `X-Api-Key`, or is that of a session in a cookie. A browser
/// may add a cookie to what another site's page asks for: then anything but GET and HEAD, and a WebSocket,
/// must come with an Origin.
Visitor check_access(const RequestHead& head, const AccessRules& rules);
/// The session in the request's cookies; absent: none, or one that is not known.
std::optional<std::string> session_of(const RequestHead& head, const AccessRules& rules);
/// The same for an address that strangers may ask for: absent if the client has shown no token or key.
std::optional<Visitor> seek_access(const RequestHead& head, const AccessRules& rules);
/// The part of it that strangers, too, must pass: the checks of Host and Origin. Throws HttpError 400, 403 or
/// 421.
void check_site(const RequestHead& head, const AccessRules& rules);
/// The check of Host alone, for what a link of another site may lead to. Throws HttpError 400 or 421.
void check_host(const RequestHead& head, const AccessRules& rules);

/// The allowed values of Host for a daemon at this address: the address and localhost, with the port; and
/// `names`. A name with a port is taken as it is; one without also stands for the ports 80 and 443, where a
/// proxy listens.
std::vector<std::string> hosts_for(const std::string& address, unsigned port,
                                   const std::vector<std::string>& names);

}  // namespace unicursal::host
