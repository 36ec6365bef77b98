// One client's WebSocket: texts go out in order. A client that does not keep up, or that has not been heard
// after two pings, is disconnected, so that it costs neither memory nor time. Everything belongs to the
// loop's thread.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <asio/generic/stream_protocol.hpp>
#include <asio/steady_timer.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "host/http/websocket.hpp"

namespace unicursal::host {

class EventStream : public std::enable_shared_from_this<EventStream> {
 public:
  /// Texts that may wait for a client.
  static constexpr std::size_t most_waiting = 256;

  explicit EventStream(asio::generic::stream_protocol::socket socket);

  /// Runs until either side closes. `first`: bytes that came behind the handshake.
  asio::awaitable<void> run(std::string first);
  void send(const std::string& text);
  /// Closes with this code (RFC 6455, 7.4.1) after sending the waiting texts.
  void close(std::uint16_t code);
  bool open() const { return open_; }
  asio::any_io_executor executor() { return socket_.get_executor(); }
  /// Called with each text that the client sends in one frame; others are read and left aside. `take` may
  /// own what it needs, but not this object.
  void on_text(std::function<void(const std::string&)> take) { on_text_ = std::move(take); }
  /// For a client that has shown no right in its request: what happens when it does so later.
  void on_proof(std::function<bool()> admit) { on_proof_ = std::move(admit); }
  /// The client has shown its right, and may stay. Returns whether a place is left for it.
  bool admit() { return !on_proof_ || on_proof_(); }

 private:
  asio::awaitable<void> write();
  asio::awaitable<void> read(std::string first);
  void take(const Frame& frame);
  void put(std::string bytes);
  void abort();

  asio::generic::stream_protocol::socket socket_;
  asio::steady_timer wake_, silence_;
  std::chrono::steady_clock::time_point next_ping_;
  int unanswered_ = 0;  ///< pings since the client was last heard
  std::deque<std::string> waiting_;
  std::function<void(const std::string&)> on_text_;
  std::function<bool()> on_proof_;
  bool open_ = true;
  bool closing_ = false;
  bool written_ = false;        ///< everything, the close frame included
  bool client_closes_ = false;  ///< it has sent its close frame
};

}  // namespace unicursal::host
