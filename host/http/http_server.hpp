// HTTP/1.1 over TCP, and over a Unix socket, on the loop that also runs the link, with one coroutine for each
// connection. So requests are carried out on the session's thread, without strands or locks. Requests are
// small and few; the handler has to do slow work elsewhere.
//
// Connections have places of three kinds, so that none can take those of another: connections that have shown
// no right yet (also those that wait for a further request), of which the oldest gives way to a new one;
// requests that have been admitted; and event streams. An urgent request always has a place, and so has a
// client of the Unix socket: only this user and root can connect to it.
//
// Everything is limited: connections, bytes of the head, bytes of the body (checked before it is read; one
// large body at a time, or four that somebody takes piece by piece), and the time for each. A client that
// exceeds a limit gets a 4xx and is disconnected.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/generic/stream_protocol.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/local/stream_protocol.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "host/http/event_stream.hpp"
#include "host/http/http_message.hpp"

namespace unicursal::host {

/// Takes a body while it arrives, so that it is never in memory as a whole. It is destroyed when the client
/// is gone before the end.
class BodyTaker {
 public:
  virtual ~BodyTaker() = default;
  /// Throws HttpError; the rest is not asked for then.
  virtual asio::awaitable<void> take(std::string bytes) = 0;
};

/// How a request is let in.
struct Admission {
  std::uint64_t longest_body = 0;    ///< bytes; more is refused with 413
  bool proven = true;                ///< false: anybody may ask, so it has no place among the admitted ones
  std::shared_ptr<BodyTaker> taker;  ///< null: the body becomes that of the Request
};

class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  /// Called before the body is read. Throws HttpError.
  virtual Admission admit(const RequestHead& head) = 0;
  /// Throws HttpError; any other exception becomes a 500. The answer waits as long as the error says.
  virtual asio::awaitable<Response> answer(Request request) = 0;
  /// Whether an admitted request asks for a stream of events.
  virtual bool wants_events(const RequestHead& head) const = 0;
  /// Whether an admitted request is carried out although all places of requests are taken.
  virtual bool is_urgent(const RequestHead& head) const = 0;
  /// `proven`: as in the Admission. A client that is not has the time of a request's head to show its right
  /// by a text; EventStream::admit() lets it stay.
  virtual void join(std::shared_ptr<EventStream> client, const RequestHead& head, bool proven) = 0;
};

class HttpServer {
 public:
  /// Starts to listen. Throws core::DataError if that is not possible. `handler` must outlive this object.
  HttpServer(asio::io_context& loop, const asio::ip::tcp::endpoint& at, HttpHandler& handler);
  ~HttpServer();

  /// Also listens on a Unix socket of this name in the folder, for this user and root; an old one is
  /// replaced. Throws core::DataError.
  void listen_in(const std::filesystem::path& folder, const std::string& name);
  /// Has the port that the system chose if 0 was asked for.
  asio::ip::tcp::endpoint endpoint() const { return acceptor_.local_endpoint(); }
  /// Accepts no more clients and closes all connections.
  void stop();
  /// Closes the connections that came over TCP, but not this one (RequestHead::connection), which asks for
  /// it.
  void disconnect_network(std::uint64_t except = 0);

  /// Whether every client has been let go after stop().
  bool deserted() const { return shared_->connections.empty(); }

 private:
  class Connection;
  class BodyPlace;
  template <typename Acceptor>
  asio::awaitable<void> accept(Acceptor& acceptor);

  asio::io_context& loop_;
  asio::ip::tcp::acceptor acceptor_;
  asio::local::stream_protocol::acceptor local_acceptor_;
  HttpHandler& handler_;
  struct Shared {
    std::set<Connection*> connections;
    std::uint64_t arrivals = 0;
    std::size_t large_bodies = 0, taken_bodies = 0;  ///< that are being received
  };
  /// Shared with the connections, which may outlive this object until the loop is gone.
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

/// "127.0.0.1:8377" or "[::1]:8377", numbers only. Throws core::DataError.
asio::ip::tcp::endpoint parse_endpoint(const std::string& text);

}  // namespace unicursal::host
