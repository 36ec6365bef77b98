// Which requests are let in, and who answers them, by the table of routes.
#include <fmt/format.h>

#include <algorithm>

#include "host/daemon/api_body.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/openapi.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/daemon/route.hpp"
#include "host/daemon/upload_taker.hpp"

namespace unicursal::host {
namespace {

constexpr std::uint64_t longest_json = 64 * 1024;            ///< bytes
constexpr std::uint64_t longest_request_for_key = 4 * 1024;  ///< bytes; strangers send it
constexpr std::string_view uploads_path = "/api/files/";

/// A WebSocket that follows the daemon.
class StreamFollower final : public Follower {
 public:
  explicit StreamFollower(std::shared_ptr<EventStream> stream) : stream_(std::move(stream)) {}
  bool open() const override { return stream_->open(); }
  void send(const std::string& event) override { stream_->send(event); }

 private:
  std::shared_ptr<EventStream> stream_;
};

}  // namespace

/// Throws HttpError 404 or 405.
const Api::Route& Api::route_of(const RequestHead& head) {
  const std::string_view asked = head.method == "HEAD" ? "GET" : std::string_view(head.method);
  std::string allowed;
  for (const Route& route : Route::all()) {
    if (!route.matches(head.path)) continue;
    if (route.method == asked) return route;
    allowed += (allowed.empty() ? "" : ", ") + std::string(route.method);
    if (route.method == "GET") allowed += ", HEAD";
  }
  if (!allowed.empty()) throw HttpError::wrong_method("that cannot be done with this address", allowed);
  throw HttpError(404, "there is no such address; the API is described in API.md");
}

/// Whether strangers, too, may ask for that.
bool Api::is_open(const RequestHead& head) {
  const auto open = [&](const Route& route) { return route.open && route.matches(head.path); };
  return std::any_of(Route::all().begin(), Route::all().end(), open);
}

Admission Api::let_in(const RequestHead& head) {
  if (is_open(head)) {
    const Route& route = route_of(head);
    const bool follows = !route.handler;
    if (route.handler == &Api::show_page)
      check_host(head, rules_);  // a link of another site may lead to the page
    else if (!follows)
      check_site(head, rules_);
    return {longest_request_for_key, follows && seek_access(head, rules_), nullptr};
  }
  const Visitor visitor = check_access(head, rules_);
  const Route& route = route_of(head);
  if (visitor.right < route.right && route.right == Right::all)
    throw HttpError(403,
                    fmt::format("the key \"{}\" may not do that, which takes the token of the daemon's owner",
                                visitor.name));
  if (visitor.right < route.right)
    throw HttpError(403, fmt::format("the key \"{}\" has the right to {} only; make another with `unicursal "
                                     "keys --new NAME --right {}`",
                                     visitor.name, name(visitor.right), name(route.right)));
  if (route.handler == &Api::octo_upload && head.method == "POST") {
    const std::string boundary = form_boundary(head.header("content-type").value_or(""));
    return {largest_form, true, std::make_shared<UploadTaker>(daemon_, boundary, head.content_length)};
  }
  if (route.handler != &Api::keep_file) return {longest_json, true, nullptr};
  const auto [upload, file] = names_behind(head.path, uploads_path);
  if (!is_plain_name(upload) || !is_plain_name(file))
    throw HttpError(400, "names of uploads hold letters, digits, dots, dashes and underscores only");
  return {largest_upload, true, nullptr};
}

Admission Api::admit(const RequestHead& head) {
  try {
    return let_in(head);
  } catch (const HttpError& refused) {
    throw refusal_to(refused, head.peer);
  }
}

bool Api::wants_events(const RequestHead& head) const {
  return !route_of(head).handler;
}

/// What makes a printer safe; it must not be locked out.
bool Api::is_urgent(const RequestHead& head) const {
  return head.path == "/api/print/stop" || head.path == "/api/print/cancel" ||
         head.path == "/api/print/pause" || head.path == "/api/printer/command" ||
         head.path == "/api/printer/cancel" || (head.path == "/api/job" && head.method == "POST");
}

asio::awaitable<Response> Api::answer(Request request) {
  const Route& route = route_of(request);
  const std::string asked = route.method == "GET" ? "" : request.method + " " + request.path;
  try {
    Response response = co_await (this->*route.handler)(std::move(request));
    if (!asked.empty()) log_line(asked + ": done");
    co_return response;
  } catch (const Refused& refused) {
    if (!asked.empty()) log_line(asked + ": refused: " + refused.what());
    throw http_error(refused);
  } catch (const IdleRefused& refused) {
    if (!asked.empty()) log_line(asked + ": refused: " + refused.what());
    throw http_error(refused);
  } catch (const std::exception& error) {
    if (!asked.empty()) log_line(asked + ": refused: " + error.what());
    throw;
  }
}

void Api::join(std::shared_ptr<EventStream> client, const RequestHead& head, bool proven) {
  if (head.path == push_path) return push_to(*client, proven, daemon_, sessions_);
  daemon_.join(std::make_unique<StreamFollower>(std::move(client)));
}

asio::awaitable<Response> Api::openapi(Request) {
  co_return plain_reply(openapi_document());
}

}  // namespace unicursal::host
