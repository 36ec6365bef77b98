// The daemon's HTTP API (API.md): which address does what, who may, and how much they may send.
#pragma once

#include "host/daemon/access.hpp"
#include "host/daemon/daemon.hpp"
#include "host/http/http_server.hpp"

namespace unicursal::host {

class Api : public HttpHandler {
 public:
  explicit Api(Daemon& daemon) : daemon_(daemon) {}
  /// Before anybody is let in: nobody is, until this is told.
  void set_rules(AccessRules rules) { rules_ = std::move(rules); }

  std::uint64_t admit(const RequestHead& head) override;
  asio::awaitable<Response> answer(Request request) override;
  bool wants_events(const RequestHead& head) const override;
  void join(std::shared_ptr<EventStream> client) override { daemon_.join(std::move(client)); }

 private:
  asio::awaitable<Response> answer_jobs(const Request& request);
  asio::awaitable<Response> answer_files(Request request);
  Response answer_print(const Request& request);

  Daemon& daemon_;
  AccessRules rules_{random_token(), {}, {}};
};

}  // namespace unicursal::host
