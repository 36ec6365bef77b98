// The daemon's HTTP API (API.md): what each address does, who may use it, and how much may be sent.
#pragma once

#include <functional>
#include <string>

#include "host/daemon/access.hpp"
#include "host/daemon/daemon.hpp"
#include "host/http/http_server.hpp"

namespace unicursal::host {

class Api : public HttpHandler {
 public:
  explicit Api(Daemon& daemon) : daemon_(daemon) {}
  /// Nobody is let in before this is called.
  void set_rules(AccessRules rules) { rules_ = std::move(rules); }
  struct Tokens {
    std::string all, metrics;
  };
  /// Makes new tokens, and lets those go who knew the old ones. Throws core::DataError.
  void on_renewal(std::function<Tokens()> renew) { renew_ = std::move(renew); }

  std::uint64_t admit(const RequestHead& head) override;
  asio::awaitable<Response> answer(Request request) override;
  bool wants_events(const RequestHead& head) const override;
  bool is_urgent(const RequestHead& head) const override;
  void join(std::shared_ptr<EventStream> client) override;

 private:
  struct Route;
  static const Route& route_of(const RequestHead& head);

  asio::awaitable<Response> status(Request request);
  asio::awaitable<Response> printer(Request request);
  asio::awaitable<Response> metrics(Request request);
  asio::awaitable<Response> list_jobs(Request request);
  asio::awaitable<Response> add_job(Request request);
  asio::awaitable<Response> show_job(Request request);
  asio::awaitable<Response> remove_job(Request request);
  asio::awaitable<Response> list_files(Request request);
  asio::awaitable<Response> keep_file(Request request);
  asio::awaitable<Response> remove_upload(Request request);
  asio::awaitable<Response> start(Request request);
  asio::awaitable<Response> pause(Request request);
  asio::awaitable<Response> resume(Request request);
  asio::awaitable<Response> answer_prompt(Request request);
  asio::awaitable<Response> cancel(Request request);
  asio::awaitable<Response> stop(Request request);
  asio::awaitable<Response> set_temperature(Request request);
  asio::awaitable<Response> set_flow(Request request);
  asio::awaitable<Response> set_speed(Request request);
  asio::awaitable<Response> renew_token(Request request);

  Daemon& daemon_;
  AccessRules rules_{random_token(), {}, {}};
  std::function<Tokens()> renew_;
};

}  // namespace unicursal::host
