#include "host/daemon/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <asio/connect.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>
#include <asio/write.hpp>
#include <charconv>
#include <memory>
#include <optional>

#include "core/text/wording.hpp"

namespace unicursal::host {
namespace {

using asio::ip::tcp;

constexpr std::string_view http_scheme = "http://", blank_line = "\r\n\r\n";
constexpr std::size_t longest_camera_head = 16 * 1024;  ///< bytes
constexpr int most_exposures = 4;                       ///< at once

HttpError bad_address(const char* what) {
  return {422, "out_of_range",
          fmt::format("the camera's address {}; write for example http://192.168.1.7/snapshot.jpg", what)};
}

HttpError no_picture(const std::string& what) {
  return {502, "no_answer", "the camera " + what};
}

/// One request to a camera: a connection, and the time until which it may last.
class Exposure {
 public:
  Exposure(asio::any_io_executor executor, CameraAddress address)
      : address_(std::move(address)), resolver_(executor), socket_(executor), deadline_(executor) {}

  asio::awaitable<Response> picture(std::chrono::milliseconds patience);

 private:
  asio::awaitable<void> connect();
  asio::awaitable<void> receive();
  void check(const asio::error_code& error, const char* what) const;
  std::size_t head_end() const { return received_.find(blank_line); }
  void read_camera_head();

  const CameraAddress address_;
  tcp::resolver resolver_;
  tcp::socket socket_;
  asio::steady_timer deadline_;
  std::shared_ptr<bool> late_ = std::make_shared<bool>(false);  ///< shared: the timer may outlive this object
  std::string received_;
  std::optional<std::size_t> length_;  ///< of the picture, if the camera says it
};

void Exposure::check(const asio::error_code& error, const char* what) const {
  if (*late_) throw HttpError(504, "the camera has not answered in time; see whether its address is right");
  if (error) throw no_picture(fmt::format("{} ({})", what, error.message()));
}

asio::awaitable<void> Exposure::connect() {
  asio::error_code error;
  const auto found = co_await resolver_.async_resolve(address_.host, address_.port,
                                                      asio::redirect_error(asio::use_awaitable, error));
  check(error, "has an unknown name");
  co_await asio::async_connect(socket_, found, asio::redirect_error(asio::use_awaitable, error));
  check(error, "cannot be reached");
}

/// HTTP/1.0, so that the answer does not come in chunks.
asio::awaitable<void> Exposure::receive() {
  const bool v6 = address_.host.find(':') != std::string::npos;
  const std::string request = fmt::format(
      "GET {} HTTP/1.0\r\nHost: {}:{}\r\nUser-Agent: unicursal\r\nAccept: image/jpeg, image/png\r\n\r\n",
      address_.target, v6 ? "[" + address_.host + "]" : address_.host, address_.port);
  asio::error_code error;
  co_await asio::async_write(socket_, asio::buffer(request),
                             asio::redirect_error(asio::use_awaitable, error));
  check(error, "does not listen");
  std::array<char, 16 * 1024> bytes;
  while (!error) {
    const std::size_t size = co_await socket_.async_read_some(
        asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, error));
    if (*late_) check(error, "");
    received_.append(bytes.data(), size);
    const std::size_t head = head_end();
    if (head == std::string::npos) {
      if (received_.size() > longest_camera_head) throw no_picture("answers with something that is not HTTP");
      continue;
    }
    if (!length_) read_camera_head();
    const std::size_t body = received_.size() - head - blank_line.size();
    if (std::max(body, length_.value_or(0)) > largest_picture)
      throw no_picture("answers with more than 4 MiB; set a smaller size of its pictures");
    if (length_ && body >= *length_) break;
  }
}

/// The status, and the length of the body.
void Exposure::read_camera_head() {
  const std::string head = core::lower(std::string_view(received_).substr(0, head_end()));
  int status = 0;
  if (!head.starts_with("http/1.") || head.size() < 12 ||
      std::from_chars(head.data() + 9, head.data() + 12, status).ec != std::errc())
    throw no_picture("answers with something that is not HTTP");
  if (status >= 300 && status < 400)
    throw no_picture("sends the daemon to another address, where it does not go; set that one");
  if (status != 200)
    throw no_picture(fmt::format("answers with status {}; see whether its address is right", status));
  if (head.find("\r\ncontent-type: multipart/") != std::string::npos)
    throw no_picture("answers with a film; set the address of its single pictures (snapshots)");
  constexpr std::string_view name = "\r\ncontent-length:";
  const std::size_t at = head.find(name);
  if (at == std::string::npos) return;
  const std::size_t digits = head.find_first_not_of(' ', at + name.size());
  std::size_t length = 0;
  if (digits == std::string::npos ||
      std::from_chars(head.data() + digits, head.data() + head.size(), length).ec != std::errc())
    throw no_picture("answers with a length that is not a number, or too large");
  length_ = length;
}

asio::awaitable<Response> Exposure::picture(std::chrono::milliseconds patience) {
  deadline_.expires_after(patience);
  deadline_.async_wait([this, here = std::weak_ptr(late_)](const asio::error_code& cut) {
    if (cut || here.expired()) return;
    *late_ = true;
    resolver_.cancel();
    asio::error_code ignored;
    socket_.close(ignored);
  });
  co_await connect();
  co_await receive();
  deadline_.cancel();
  const std::size_t head = head_end();
  if (head == std::string::npos) throw no_picture("has closed the connection before it answered");
  Response response;
  response.body = received_.substr(head + blank_line.size());
  if (length_ && response.body.size() < *length_)
    throw no_picture("has broken off in the middle of a picture");
  if (length_) response.body.resize(*length_);
  if (response.body.starts_with("\xff\xd8\xff"))
    response.type = "image/jpeg";
  else if (response.body.starts_with("\x89PNG\r\n\x1a\n"))
    response.type = "image/png";
  else
    throw no_picture("answers with something that is neither JPEG nor PNG");
  co_return response;
}

/// Counts while a picture is being fetched.
class ExposurePlace {
 public:
  ExposurePlace() {
    if (taken_ >= most_exposures)
      throw HttpError(503, "several pictures are being fetched; ask again in a moment");
    ++taken_;
  }
  ~ExposurePlace() { --taken_; }
  ExposurePlace(const ExposurePlace&) = delete;
  ExposurePlace& operator=(const ExposurePlace&) = delete;

 private:
  static inline int taken_ = 0;  ///< on the loop's thread only
};

}  // namespace

CameraAddress parse_camera_address(const std::string& address) {
  if (core::lower(address.substr(0, http_scheme.size())) != http_scheme)
    throw bad_address("does not begin with http://");
  const bool visible =
      std::all_of(address.begin(), address.end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (!visible || address.size() > longest_camera_address) throw bad_address("holds spaces, or is too long");
  CameraAddress parsed;
  std::string rest = address.substr(http_scheme.size());
  const std::size_t slash = std::min(rest.find_first_of("/?#"), rest.size());
  parsed.target = rest.substr(slash, rest.find('#') - slash);
  if (!parsed.target.starts_with('/')) parsed.target.insert(0, "/");
  rest.resize(slash);
  if (rest.find('@') != std::string::npos)
    throw bad_address("holds a password, which would cross the network for each picture");
  const std::size_t bracket = rest.find(']');
  const std::size_t colon = rest.find(':', bracket == std::string::npos ? 0 : bracket);
  parsed.host = rest.substr(0, colon);
  if (colon != std::string::npos) parsed.port = rest.substr(colon + 1);
  if (parsed.host.starts_with('[') && parsed.host.ends_with(']'))
    parsed.host = parsed.host.substr(1, parsed.host.size() - 2);
  unsigned short port = 0;
  const char* end = parsed.port.data() + parsed.port.size();
  const auto [stop, error] = std::from_chars(parsed.port.data(), end, port);
  if (parsed.host.empty() || error != std::errc() || stop != end || port == 0)
    throw bad_address("names no computer, or a port that does not exist");
  return parsed;
}

asio::awaitable<Response> fetch_picture(CameraAddress address, std::chrono::milliseconds patience) {
  const ExposurePlace place;
  Exposure exposure(co_await asio::this_coro::executor, std::move(address));
  co_return co_await exposure.picture(patience);
}

}  // namespace unicursal::host
