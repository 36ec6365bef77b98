#include "host/http/event_stream.hpp"

#include <array>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/redirect_error.hpp>
#include <asio/use_awaitable.hpp>
#include <asio/write.hpp>

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto ping_interval = 20s;
constexpr int most_unanswered = 2;  ///< pings
constexpr auto patience = 15s;      ///< for one write, and for the client to close
constexpr std::uint16_t normal_end = 1000, try_again_later = 1013;

}  // namespace

EventStream::EventStream(asio::generic::stream_protocol::socket socket)
    : socket_(std::move(socket)),
      wake_(socket_.get_executor()),
      silence_(socket_.get_executor()),
      next_ping_(std::chrono::steady_clock::now() + ping_interval) {}

asio::awaitable<void> EventStream::run(std::string first) {
  const auto self = shared_from_this();
  asio::co_spawn(
      socket_.get_executor(), [self]() -> asio::awaitable<void> { co_await self->write(); }, asio::detached);
  co_await read(std::move(first));
  abort();  // others may still hold this object, and with it the socket
}

void EventStream::send(const std::string& text) {
  if (closing_) return;
  if (waiting_.size() >= most_waiting) return close(try_again_later);
  put(encode({Frame::Kind::text, text}));
}

void EventStream::close(std::uint16_t code) {
  if (closing_) return;
  put(close_frame(code));
  closing_ = true;
}

void EventStream::put(std::string bytes) {
  waiting_.push_back(std::move(bytes));
  wake_.cancel();
}

void EventStream::abort() {
  open_ = false;
  asio::error_code ignored;
  socket_.close(ignored);
  wake_.cancel();
  silence_.cancel();
}

/// Sends waiting texts, and pings between them.
asio::awaitable<void> EventStream::write() {
  const auto self = shared_from_this();
  asio::error_code error;
  while (open_ && !error) {
    if (!closing_ && std::chrono::steady_clock::now() >= next_ping_) {
      if (unanswered_ == most_unanswered) break;
      ++unanswered_;
      next_ping_ += ping_interval;
      put(encode({Frame::Kind::ping, {}}));
    }
    if (waiting_.empty()) {
      if (closing_) break;
      wake_.expires_at(next_ping_);
      asio::error_code cut;
      co_await wake_.async_wait(asio::redirect_error(asio::use_awaitable, cut));
      continue;
    }
    const std::string bytes = std::move(waiting_.front());
    waiting_.pop_front();
    silence_.expires_after(patience);
    silence_.async_wait([self](const asio::error_code& cut) {
      if (!cut) self->abort();
    });
    co_await asio::async_write(socket_, asio::buffer(bytes),
                               asio::redirect_error(asio::use_awaitable, error));
    silence_.cancel();
  }
  if (error || !open_ || client_closes_ || !closing_) co_return abort();
  written_ = true;
  // The client gets the same time to close.
  silence_.expires_after(patience);
  silence_.async_wait([self](const asio::error_code& cut) {
    if (!cut) self->abort();
  });
}

asio::awaitable<void> EventStream::read(std::string first) {
  FrameReader frames;
  frames.add(first);
  std::array<char, 2048> bytes{};
  asio::error_code error;
  bool talking = true;
  while (talking && !error) {
    try {
      while (const auto frame = client_closes_ ? std::nullopt : frames.next()) take(*frame);
    } catch (const WebSocketError& broken) {
      close(broken.code());
      talking = false;
    }
    if (client_closes_) break;
    if (!talking || !open_) break;
    const std::size_t size = co_await socket_.async_read_some(
        asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, error));
    frames.add({bytes.data(), size});
  }
  // Waiting texts are still sent; the writer has a deadline.
  while ((!talking || client_closes_) && !(client_closes_ && written_) && open_ && !error) {
    co_await socket_.async_read_some(asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, error));
  }
  silence_.cancel();
}

void EventStream::take(const Frame& frame) {
  unanswered_ = 0;
  if (frame.kind == Frame::Kind::ping && waiting_.size() < most_waiting && !closing_)
    put(encode({Frame::Kind::pong, frame.payload}));
  if (frame.kind == Frame::Kind::text && !closing_ && on_text_) on_text_(frame.payload);
  if (frame.kind == Frame::Kind::close) {
    client_closes_ = true;
    close(close_code(frame).value_or(normal_end));
  }
}

}  // namespace unicursal::host
