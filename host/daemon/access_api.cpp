// Who may do what: sessions of browsers, keys of programs, and the token.
#include <fmt/format.h>

#include "host/daemon/api.hpp"
#include "host/daemon/api_body.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::string_view keys_path = "/api/keys/";

/// Absent: "steer".
Right right_in(const json& body) {
  const std::string word = text_in(body, "right");
  if (word.empty()) return Right::steer;
  const auto right = right_named(word);
  if (!right) throw HttpError(400, "right is \"watch\", \"queue\" or \"steer\"");
  return *right;
}

}  // namespace

HttpError Api::refusal_to(const HttpError& refused, const std::string& peer) {
  return refused.code() == std::string_view("wrong_token") ? refused.late(wrong_tries_.wait_of(peer))
                                                           : refused;
}

// ---- sessions

/// OctoPrint's clients log in here, too, and send no token in the body.
asio::awaitable<Response> Api::login(Request request) {
  if (!read_object(request).contains("token")) {
    try {
      co_return co_await octo_login(request);
    } catch (const HttpError& refused) {
      throw refusal_to(refused, request.peer);
    }
  }
  const std::string token = text_in(read_object(request, {"token"}), "token");
  const auto visitor = visitor_with(token, rules_);
  if (!visitor)
    throw refusal_to(HttpError(401, "that is neither the token nor a key: `unicursal token` shows the token"),
                     request.peer);
  if (const auto before = session_of(request, rules_)) logins_.close(*before);
  Response response = reply({{"name", visitor->name}, {"right", name(visitor->right)}});
  response.headers.emplace_back("Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                          rules_.cookie, logins_.open(token)));
  co_return response;
}

asio::awaitable<Response> Api::logout(Request request) {
  read_object(request, {});
  if (const auto session = session_of(request, rules_)) logins_.close(*session);
  Response response = reply(json::object());
  response.headers.emplace_back(
      "Set-Cookie", fmt::format("{}=; HttpOnly; SameSite=Strict; Path=/; Max-Age=0", rules_.cookie));
  co_return response;
}

// ---- keys

void Api::set_keys(Keys& keys, Disconnect disconnect) {
  keys_ = &keys;
  rules_.keys = &keys;
  disconnect_ = std::move(disconnect);
}

Keys& Api::keys() {
  if (!keys_) throw HttpError(404, "this daemon has no keys");
  return *keys_;
}

/// The secrets themselves do not cross the network.
asio::awaitable<Response> Api::list_keys(Request request) {
  json all = json::array(), requests = json::array();
  for (const Key& key : keys().all()) {
    all.push_back({{"id", key.id}, {"name", key.name}, {"right", name(key.right)}, {"made", key.made}});
    if (request.by_socket) all.back()["key"] = key.secret;
  }
  for (const KeyRequest& one : keys().requests())
    requests.push_back({{"id", one.id}, {"name", one.name}, {"from", one.peer}});
  co_return reply({{"keys", all}, {"requests", requests}});
}

asio::awaitable<Response> Api::add_key(Request request) {
  const json body = read_object(request, {"name", "right"});
  const Key& key = keys().add(text_in(body, "name"), right_in(body));
  co_return reply({{"id", key.id}, {"key", key.secret}}, 201);
}

asio::awaitable<Response> Api::remove_key(Request request) {
  const std::uint64_t id = number_behind(request.path, keys_path);
  keys().remove(id);
  sessions_.clear();
  disconnect_(request.connection);
  co_return reply({{"removed", id}});
}

/// Grants or denies what a program has asked for.
asio::awaitable<Response> Api::decide_key(Request request) {
  const std::uint64_t id = number_behind(request.path, keys_path);
  const json body = read_object(request, {"grant", "right"});
  if (yes(body, "grant"))
    keys().grant(id, right_in(body));
  else
    keys().deny(id);
  co_return reply({{"decided", id}});
}

// ---- the token

/// Only the owner of the state folder may shut others out; the new token does not cross the network.
asio::awaitable<Response> Api::renew_token(Request request) {
  read_object(request, {});
  if (!request.by_socket)
    throw HttpError(403, "the token is renewed through the socket in the state folder only");
  if (!rules_.token) throw HttpError(409, "this daemon asks for no token");
  Tokens tokens = renew_();
  sessions_.clear();
  rules_.token = std::move(tokens.all);
  rules_.metrics_token = std::move(tokens.metrics);
  co_return reply(json::object());
}

}  // namespace unicursal::host
