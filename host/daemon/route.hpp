// A row of the table of routes (routes.cpp): what an address is for, who may ask for it, and who answers. The
// OpenAPI document (openapi.hpp) is made from the same rows.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "host/daemon/api.hpp"

namespace unicursal::host {

inline constexpr std::string_view push_path = "/sockjs/websocket";

/// For readers of the OpenAPI document. Names of schemas are those of host/daemon/schemas.json.
struct RouteText {
  std::string_view says = {};        ///< what the request does, or what the answer holds
  std::string_view takes = {};       ///< schema of the request's body; empty: it has none
  std::string_view gives = {};       ///< schema of the answer; empty: it is not JSON, or has no body
  int status = 200;                  ///< of the answer
  std::array<int, 6> refuses = {};   ///< statuses beside those that every request may get
  std::string_view behind = "{id}";  ///< what follows a path that ends with a slash
  std::string_view query = {};       ///< "since" or "from,limit": what may stand behind the question mark
  std::string_view type = "application/json";  ///< of the answer
};

struct Api::Route {
  std::string_view method;
  /// A path that ends with a slash is followed by anything; {name} stands for one segment.
  std::string_view path;
  asio::awaitable<Response> (Api::*handler)(Request request);  ///< null: a stream of events
  Right right = Right::watch;                                  ///< that it takes
  RouteText text = {};
  bool open = false;  ///< strangers, too, may ask

  bool matches(std::string_view asked) const;
  /// A request gets the first one that matches.
  static std::span<const Route> all();
};

}  // namespace unicursal::host
