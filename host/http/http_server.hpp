// HTTP/1.1 over TCP on the loop that also runs the link, one coroutine a connection: what a request asks for
// is then done on the session's own thread, without a strand or a lock between them. Requests are small and
// few, and slow work is the handler's to put elsewhere.
//
// What a client may do is bounded on every side: connections, bytes of the head, bytes of the body (asked for
// before it is read; of large ones there is one at a time), seconds of each. Whoever goes beyond gets a 4xx
// and is disconnected.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <memory>
#include <set>
#include <string>

#include "host/http/event_stream.hpp"
#include "host/http/http_message.hpp"

namespace unicursal::host {

class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  /// Before the body is read: the most bytes that it may have. Throws HttpError.
  virtual std::uint64_t admit(const RequestHead& head) = 0;
  /// Throws HttpError; anything else becomes a 500.
  virtual asio::awaitable<Response> answer(Request request) = 0;
  /// Whether this, having been admitted, asks for the stream of events.
  virtual bool wants_events(const RequestHead& head) const = 0;
  virtual void join(std::shared_ptr<EventStream> client) = 0;
};

class HttpServer {
 public:
  /// Listens; throws core::DataError when that is not possible. `handler` must outlive it.
  HttpServer(asio::io_context& loop, const asio::ip::tcp::endpoint& at, HttpHandler& handler);
  ~HttpServer();

  /// With the port that the system has chosen when 0 was asked for.
  asio::ip::tcp::endpoint endpoint() const { return acceptor_.local_endpoint(); }
  /// Nobody is accepted any more, and connections are closed.
  void stop();

 private:
  class Connection;
  class LargeBody;
  asio::awaitable<void> accept();

  asio::io_context& loop_;
  asio::ip::tcp::acceptor acceptor_;
  HttpHandler& handler_;
  struct Shared {
    std::set<Connection*> connections;
    bool large_body = false;  ///< one is being received; one at a time may be
  };
  /// With the connections, which may outlive this object until the loop is gone.
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

/// "127.0.0.1:8377" or "[::1]:8377", numbers only. Throws core::DataError.
asio::ip::tcp::endpoint parse_endpoint(const std::string& text);

}  // namespace unicursal::host
