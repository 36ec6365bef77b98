#include "host/daemon/access.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/wording.hpp"
#include "host/daemon/secret.hpp"

namespace unicursal::host {
namespace {

constexpr std::string_view bearer = "bearer ";  // in any case (RFC 9110, 11.1)
constexpr std::string_view token_protocol = "token.";

/// A page's script cannot set headers of a WebSocket, but it can offer protocols.
std::optional<std::string> offered_token(const RequestHead& head) {
  for (const std::string& offered : head.list("sec-websocket-protocol")) {
    if (offered.starts_with(token_protocol)) return offered.substr(token_protocol.size());
  }
  return std::nullopt;
}

std::optional<std::string> given_secret(const RequestHead& head) {
  const auto given = head.header("authorization");
  if (given && core::lower(given->substr(0, bearer.size())) == bearer) {
    const std::size_t begin = given->find_first_not_of(' ', bearer.size());
    return begin == std::string::npos ? "" : given->substr(begin);
  }
  if (const auto key = head.header("x-api-key")) return key;
  return offered_token(head);
}

struct Proof {
  std::string secret;
  bool by_cookie = false;
};

std::optional<Proof> proof_in(const RequestHead& head, const AccessRules& rules) {
  if (auto secret = given_secret(head)) return Proof{std::move(*secret)};
  if (const auto session = session_of(head, rules)) return Proof{*rules.logins->secret_of(*session), true};
  return std::nullopt;
}

bool only_looks(const RequestHead& head) {
  return (head.method == "GET" || head.method == "HEAD") && !head.header("upgrade");
}

/// Whether a host such as "printer.lan:8443" or "[fe80::1]:80" ends in a port.
bool has_port(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  return colon != std::string::npos && host.find(']', colon) == std::string::npos;
}

/// Whether one of the hosts that the rules allow is wanted. The present ones are asked for last.
template <typename Wanted>
bool any_host(const AccessRules& rules, Wanted wanted) {
  if (std::any_of(rules.hosts.begin(), rules.hosts.end(), wanted)) return true;
  if (!rules.present_hosts) return false;
  const std::vector<std::string> present = rules.present_hosts();
  return std::any_of(present.begin(), present.end(), wanted);
}

void check_origin(const RequestHead& head, const AccessRules& rules) {
  const std::string site = head.header("sec-fetch-site").value_or("none");
  const bool own_site = site == "none" || site == "same-origin";
  const auto origin = head.header("origin");
  const auto own = [&](const std::string& host) {
    return core::lower(*origin) == "http://" + host || core::lower(*origin) == "https://" + host;
  };
  if (!own_site || (origin && !any_host(rules, own)))
    throw HttpError(403, "other_site", "requests of other sites' pages are not obeyed");
}

}  // namespace

void check_host(const RequestHead& head, const AccessRules& rules) {
  if (head.by_socket) return;
  const auto host = head.header("host");
  if (!host) throw HttpError(400, "wrong_host", "the request does not say which host it is for");
  if (!any_host(rules, [given = core::lower(*host)](const std::string& one) { return one == given; }))
    throw HttpError(421, "this computer does not go by that name; allow it with --name");
}

void check_site(const RequestHead& head, const AccessRules& rules) {
  if (head.by_socket) return;
  check_host(head, rules);
  check_origin(head, rules);
}

std::optional<std::string> session_of(const RequestHead& head, const AccessRules& rules) {
  const auto cookies = head.header("cookie");
  if (!cookies || !rules.logins) return std::nullopt;
  const std::string name = rules.cookie + "=";
  std::string_view rest = *cookies;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    std::string_view cookie = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (!cookie.starts_with(name)) continue;
    std::string session(cookie.substr(name.size()));
    if (rules.logins->secret_of(session)) return session;
  }
  return std::nullopt;
}

std::optional<Visitor> visitor_with(const std::string& secret, const AccessRules& rules) {
  if (!rules.token || is_same_secret(secret, *rules.token)) return Visitor{};
  const Key* key = rules.keys ? rules.keys->with_secret(secret) : nullptr;
  if (!key) return std::nullopt;
  return Visitor{key->right, key->name};
}

Visitor check_access(const RequestHead& head, const AccessRules& rules) {
  if (head.by_socket) return {};
  check_site(head, rules);
  if (!rules.token) return {};
  const std::optional<Proof> proof = proof_in(head, rules);
  if (proof && proof->by_cookie && !only_looks(head) && !head.header("origin"))
    throw HttpError(403, "other_site", "a request with a cookie must say from which page it comes (Origin)");
  if (proof && rules.metrics_token && head.path == "/metrics" &&
      is_same_secret(proof->secret, *rules.metrics_token))
    return {Right::watch, "metrics"};
  if (const auto visitor = proof ? visitor_with(proof->secret, rules) : std::nullopt) return *visitor;
  // OctoPrint's clients, who send a key so, know 403 (docs/api/general.rst).
  const bool octoprint = !head.header("authorization") && head.header("x-api-key");
  const bool wrong = proof && !proof->by_cookie;
  throw HttpError(
      octoprint ? 403 : 401, wrong ? "wrong_token" : "no_token",
      "the token or key is missing or wrong: `unicursal keys --new NAME` makes a key on the daemon's "
      "computer, and `unicursal token` shows the token");
}

std::optional<Visitor> seek_access(const RequestHead& head, const AccessRules& rules) {
  if (head.by_socket || !rules.token || proof_in(head, rules)) return check_access(head, rules);
  check_site(head, rules);
  return std::nullopt;
}

std::vector<std::string> hosts_for(const std::string& address, unsigned port,
                                   const std::vector<std::string>& names) {
  const std::vector<std::string> own = {
      "localhost", "127.0.0.1", "[::1]",
      address.find(':') == std::string::npos ? address : "[" + address + "]"};
  std::vector<std::string> all;
  for (const std::string& host : own) {
    all.push_back(fmt::format("{}:{}", host, port));
    if (port == 80) all.push_back(host);
  }
  for (const std::string& given : names) {
    const std::string name = core::lower(given);
    all.push_back(name);
    if (has_port(name)) continue;
    for (const unsigned each : {port, 80U, 443U}) all.push_back(fmt::format("{}:{}", name, each));
  }
  return all;
}

}  // namespace unicursal::host
