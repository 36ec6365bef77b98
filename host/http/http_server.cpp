#include "host/http/http_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/use_awaitable.hpp>
#include <asio/write.hpp>
#include <charconv>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "host/files/descriptor.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;
using asio::ip::tcp;
using Local = asio::local::stream_protocol;
using Socket = asio::generic::stream_protocol::socket;

constexpr std::size_t most_unproven = 64, most_requests = 64, most_streams = 64;
constexpr auto head_patience =
    10s;  ///< from the first byte of a request, or the last answer, to its blank line
constexpr auto body_patience = 10s;                 ///< and beyond that, at least:
constexpr std::uint64_t slowest_body = 256 * 1024;  ///< bytes/s
constexpr auto longest_silence = 30s;               ///< within a body that somebody takes
constexpr std::uint64_t large_body = 1024 * 1024;   ///< bytes
constexpr std::size_t most_large_bodies = 1, most_taken_bodies = 4;
constexpr auto answer_patience = 30s;  ///< for the client to receive an answer
constexpr auto farewell =
    2s;  ///< how long a refused client's bytes are still read, so that it gets the answer
constexpr std::size_t longest_farewell = 4 * 1024 * 1024;  ///< bytes

constexpr std::uint16_t no_right = 1008, try_again_later = 1013;  ///< RFC 6455, 7.4.1

constexpr std::string_view end_of_head = "\r\n\r\n";

/// Prepares a connection; returns false for one that is not wanted.
bool welcome(tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  return true;
}

bool welcome(Local::socket& socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(socket.native_handle(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == ::geteuid() || peer.uid == 0;
}

/// The address of whoever has connected; empty if it has none.
std::string peer_of(const Socket& socket) {
  asio::error_code error;
  const auto peer = socket.remote_endpoint(error);
  if (error || (peer.protocol().family() != AF_INET && peer.protocol().family() != AF_INET6)) return {};
  char name[NI_MAXHOST];
  const auto size = static_cast<socklen_t>(peer.size());
  if (::getnameinfo(peer.data(), size, name, sizeof name, nullptr, 0, NI_NUMERICHOST) != 0) return {};
  return name;
}

}  // namespace

class HttpServer::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Socket socket, bool local, HttpServer& server)
      : socket_(std::move(socket)),
        deadline_(socket_.get_executor()),
        server_(server),
        all_(server.shared_),
        local_(local) {
    number_ = ++all_->arrivals;
    all_->connections.insert(this);
    await_proof();
  }
  ~Connection() { all_->connections.erase(this); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  asio::awaitable<void> run();
  bool local() const { return local_; }
  std::uint64_t number() const { return number_; }
  void close() {
    place_ = Place::none;
    asio::error_code ignored;
    socket_.close(ignored);
    if (events_) events_->close(1001);
  }

 private:
  enum class Place { unproven, request, stream, none };  // `none` is not counted

  std::size_t count(Place place) const;
  void await_proof();
  void enter(Place place, std::size_t most);
  asio::awaitable<bool> serve_one();
  asio::awaitable<std::optional<RequestHead>> read_head();
  asio::awaitable<void> read_body(Request& request);
  asio::awaitable<void> pass_body(const Request& request);
  asio::awaitable<bool> read_some();
  asio::awaitable<void> write(std::string bytes);
  asio::awaitable<void> refuse(Response response);
  asio::awaitable<Response> answered(Request request);
  asio::awaitable<void> stream_events(RequestHead head, bool proven);
  bool enter_stream();
  asio::awaitable<void> pause(std::chrono::milliseconds time);
  void expire_after(asio::steady_timer::duration patience);

  Socket socket_;
  asio::steady_timer deadline_;
  HttpServer& server_;
  const std::shared_ptr<Shared> all_;
  const bool local_;  ///< it came over the Unix socket
  std::shared_ptr<EventStream> events_;
  Place place_ = Place::none;
  std::uint64_t number_ = 0, arrival_ = 0;  ///< `arrival_`: order of those without proof
  std::string buffer_;
  bool expired_ = false;
  bool head_only_ = false;  ///< the present request is HEAD
};

/// The place of a body that is large in memory, or that is taken piece by piece: together such bodies would
/// fill the memory, or keep the disk from everything else.
class HttpServer::BodyPlace {
 public:
  BodyPlace(std::shared_ptr<Shared> all, std::size_t Shared::*kind, std::size_t most)
      : all_(std::move(all)), kind_(kind) {
    if ((*all_).*kind_ >= most) throw HttpError(503, "other files are being sent; try again in a moment");
    ++((*all_).*kind_);
  }
  ~BodyPlace() { --((*all_).*kind_); }
  BodyPlace(const BodyPlace&) = delete;
  BodyPlace& operator=(const BodyPlace&) = delete;

 private:
  std::shared_ptr<Shared> all_;
  std::size_t Shared::*kind_;
};

std::size_t HttpServer::Connection::count(Place place) const {
  return static_cast<std::size_t>(
      std::count_if(all_->connections.begin(), all_->connections.end(),
                    [place](const Connection* one) { return one->place_ == place; }));
}

/// Takes a place of the unproven; the one that has waited longest gives way.
void HttpServer::Connection::await_proof() {
  if (local_) return;
  place_ = Place::unproven;
  arrival_ = ++all_->arrivals;
  if (count(Place::unproven) <= most_unproven) return;
  Connection* oldest = this;
  for (Connection* one : all_->connections) {
    if (one->place_ == Place::unproven && one->arrival_ < oldest->arrival_) oldest = one;
  }
  oldest->close();
}

void HttpServer::Connection::enter(Place place, std::size_t most) {
  if (local_ && place == Place::request) return;
  if (count(place) >= most) throw HttpError(503, "too many connections; try again later");
  place_ = place;
}

void HttpServer::Connection::expire_after(asio::steady_timer::duration patience) {
  expired_ = false;
  deadline_.expires_after(patience);
  deadline_.async_wait([this, self = shared_from_this()](const asio::error_code& cut) {
    if (cut) return;
    expired_ = true;
    asio::error_code ignored;
    socket_.cancel(ignored);
  });
}

/// Returns false at the end of the stream.
asio::awaitable<bool> HttpServer::Connection::read_some() {
  std::array<char, 16 * 1024> bytes;
  asio::error_code error;
  const std::size_t size =
      co_await socket_.async_read_some(asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, error));
  if (expired_) throw HttpError(408, "the request did not come in time");
  buffer_.append(bytes.data(), size);
  co_return !error;
}

/// Returns nullopt if the client has left between two requests.
asio::awaitable<std::optional<RequestHead>> HttpServer::Connection::read_head() {
  expire_after(head_patience);
  std::size_t end = buffer_.find(end_of_head);
  while (end == std::string::npos) {
    if (buffer_.size() > longest_head) throw HttpError(431, "the request's head is too long");
    bool more = false;
    try {
      more = co_await read_some();
    } catch (const HttpError&) {
      if (buffer_.empty()) co_return std::nullopt;  // a connection kept for later, not a slow request
      throw;
    }
    if (!more) co_return std::nullopt;
    end = buffer_.find(end_of_head);
  }
  if (end > longest_head) throw HttpError(431, "the request's head is too long");
  RequestHead head = parse_request(std::string_view(buffer_).substr(0, end));
  buffer_.erase(0, end + end_of_head.size());
  co_return head;
}

asio::awaitable<void> HttpServer::Connection::read_body(Request& request) {
  const std::uint64_t length = request.content_length;
  expire_after(body_patience + std::chrono::seconds(length / slowest_body));
  while (buffer_.size() < length) {
    const bool more = co_await read_some();
    if (!more) throw HttpError(400, "the body ends too soon");
  }
  std::string rest = buffer_.substr(length);
  buffer_.resize(length);
  request.body = std::exchange(buffer_, std::move(rest));
}

/// A client that is silent for long, or slow in all, is refused.
asio::awaitable<void> HttpServer::Connection::pass_body(const Request& request) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + body_patience + std::chrono::seconds(request.content_length / slowest_body);
  for (std::uint64_t left = request.content_length; left > 0;) {
    if (buffer_.empty()) {
      expire_after(std::min<Clock::duration>(longest_silence, end - Clock::now()));
      const bool more = co_await read_some();
      if (!more && buffer_.empty()) throw HttpError(400, "the body ends too soon");
      deadline_.cancel();
    }
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer_.size()));
    std::string piece = buffer_.substr(0, size);
    buffer_.erase(0, size);
    left -= size;
    co_await request.taker->take(std::move(piece));
  }
}

asio::awaitable<void> HttpServer::Connection::write(std::string bytes) {
  expire_after(answer_patience);
  asio::error_code error;
  co_await asio::async_write(socket_, asio::buffer(bytes), asio::redirect_error(asio::use_awaitable, error));
  deadline_.cancel();
  if (error) throw asio::system_error(error);
}

/// Answers, and reads on for a moment: closing at once would reset the connection before the client sees the
/// answer.
asio::awaitable<void> HttpServer::Connection::refuse(Response response) {
  co_await write(to_text(response, false, !head_only_));
  asio::error_code error;
  socket_.shutdown(Socket::shutdown_send, error);
  std::array<char, 16 * 1024> bytes;
  expire_after(farewell);
  for (std::size_t taken = 0; !error && taken < longest_farewell;) {
    taken += co_await socket_.async_read_some(asio::buffer(bytes),
                                              asio::redirect_error(asio::use_awaitable, error));
  }
  deadline_.cancel();
}

asio::awaitable<void> HttpServer::Connection::pause(std::chrono::milliseconds time) {
  if (time == time.zero()) co_return;
  asio::steady_timer timer(socket_.get_executor(), time);
  co_await timer.async_wait(asio::use_awaitable);
}

asio::awaitable<Response> HttpServer::Connection::answered(Request request) {
  std::optional<HttpError> failed;
  try {
    co_return co_await server_.handler_.answer(std::move(request));
  } catch (const HttpError& refused) {
    failed = refused;
  } catch (const std::exception& error) {
    failed = HttpError(500, error.what());
  }
  co_await pause(failed->wait());
  co_return error_response(*failed);
}

asio::awaitable<void> HttpServer::Connection::stream_events(RequestHead head, bool proven) {
  const auto key = head.header("sec-websocket-key");
  if (head.method != "GET" || !key || !is_websocket_key(*key) || !head.lists("connection", "upgrade") ||
      !head.lists("upgrade", "websocket") || head.header("sec-websocket-version") != "13")
    throw HttpError(426, "events come by WebSocket, version 13");
  if (proven) enter(Place::stream, most_streams);
  Response response;
  response.status = 101;
  response.headers = {
      {"Upgrade", "websocket"}, {"Connection", "Upgrade"}, {"Sec-WebSocket-Accept", accept_key(*key)}};
  if (head.lists("sec-websocket-protocol", "unicursal.v1"))
    response.headers.emplace_back("Sec-WebSocket-Protocol", "unicursal.v1");
  co_await write(to_text(response, true));
  events_ = std::make_shared<EventStream>(std::move(socket_));
  if (!proven) {
    events_->on_proof([this] { return enter_stream(); });
    deadline_.expires_after(head_patience);
    deadline_.async_wait([this, self = shared_from_this()](const asio::error_code& cut) {
      if (!cut && place_ == Place::unproven) events_->close(no_right);
    });
  }
  server_.handler_.join(events_, head, proven);
  co_await events_->run(std::move(buffer_));
}

/// Returns false if all places are taken; the client is let go then.
bool HttpServer::Connection::enter_stream() {
  if (place_ == Place::stream) return true;
  if (place_ != Place::unproven) return false;
  if (count(Place::stream) >= most_streams) {
    events_->close(try_again_later);
    return false;
  }
  place_ = Place::stream;
  deadline_.cancel();
  return true;
}

/// Returns whether another request may follow.
asio::awaitable<bool> HttpServer::Connection::serve_one() {
  std::optional<RequestHead> head = co_await read_head();
  if (!head) co_return false;
  head->by_socket = local_;
  head->peer = peer_of(socket_);
  head->connection = number_;
  head_only_ = head->method == "HEAD";
  Admission admission = server_.handler_.admit(*head);
  if (server_.handler_.wants_events(*head)) {
    co_await stream_events(std::move(*head), admission.proven);
    co_return false;
  }
  if (admission.proven) enter(Place::request, server_.handler_.is_urgent(*head) ? SIZE_MAX : most_requests);
  if (head->content_length > admission.longest_body)
    throw HttpError(
        413, fmt::format("the body is too large; here it has {} bytes at most", admission.longest_body));
  Request request;
  static_cast<RequestHead&>(request) = std::move(*head);
  request.taker = std::move(admission.taker);
  std::optional<BodyPlace> place;
  if (request.taker)
    place.emplace(all_, &Shared::taken_bodies, most_taken_bodies);
  else if (request.content_length > large_body)
    place.emplace(all_, &Shared::large_bodies, most_large_bodies);
  if (request.content_length > 0 && request.lists("expect", "100-continue"))
    co_await write("HTTP/1.1 100 Continue\r\n\r\n");
  if (request.taker)
    co_await pass_body(request);
  else
    co_await read_body(request);
  deadline_.cancel();
  const bool keep = request.keep_alive;
  const Response response = co_await answered(std::move(request));
  co_await write(to_text(response, keep, !head_only_));
  if (keep) await_proof();
  co_return keep;
}

asio::awaitable<void> HttpServer::Connection::run() {
  const auto self = shared_from_this();
  std::optional<HttpError> refusal;
  try {
    bool more = true;
    while (more) more = co_await serve_one();
  } catch (const HttpError& refused) {
    refusal = refused;
  } catch (const std::exception&) {
    // The client is gone.
  }
  try {
    if (refusal && place_ != Place::unproven && place_ != Place::none) await_proof();
    if (refusal) co_await pause(refusal->wait());
    if (refusal) co_await refuse(error_response(*refusal));
  } catch (const std::exception&) {
  }
  deadline_.cancel();
}

HttpServer::HttpServer(asio::io_context& loop, const tcp::endpoint& at, HttpHandler& handler)
    : loop_(loop), acceptor_(loop), local_acceptor_(loop), handler_(handler) {
  asio::error_code error;
  acceptor_.open(at.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(at, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw core::DataError(
        "", "--listen",
        fmt::format("{}:{} cannot be listened on ({})", at.address().to_string(), at.port(), error.message()),
        "choose another port, or end the program that has it");
  }
  asio::co_spawn(
      loop_, [this]() -> asio::awaitable<void> { co_await accept(acceptor_); }, asio::detached);
}

HttpServer::~HttpServer() = default;

void HttpServer::listen_in(const std::filesystem::path& folder, const std::string& name) {
  // Addresses of sockets are short; this one is, however long the folder's name.
  const Descriptor at(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  const std::string address = fmt::format("/proc/self/fd/{}/{}", at.get(), name);
  std::error_code ignored;
  std::filesystem::remove(folder / name, ignored);
  asio::error_code error;
  const mode_t before = ::umask(0177);
  local_acceptor_.open(Local(), error);
  if (!error) local_acceptor_.bind(Local::endpoint(address), error);
  ::umask(before);
  if (!error) local_acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw core::DataError((folder / name).string(), "", "cannot be made (" + error.message() + ")",
                          "check the permissions, or name another folder with --state");
  }
  asio::co_spawn(
      loop_, [this]() -> asio::awaitable<void> { co_await accept(local_acceptor_); }, asio::detached);
}

template <typename Acceptor>
asio::awaitable<void> HttpServer::accept(Acceptor& acceptor) {
  asio::steady_timer pause(loop_);
  while (acceptor.is_open()) {
    asio::error_code error;
    auto socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
    if (error == asio::error::operation_aborted || !acceptor.is_open()) co_return;
    if (error) {  // for example no descriptor is left, which passes
      pause.expires_after(100ms);
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
      continue;
    }
    if (!welcome(socket)) continue;
    constexpr bool local = std::is_same_v<Acceptor, Local::acceptor>;
    const auto connection = std::make_shared<Connection>(Socket(std::move(socket)), local, *this);
    asio::co_spawn(
        loop_, [connection]() -> asio::awaitable<void> { co_await connection->run(); }, asio::detached);
  }
}

void HttpServer::stop() {
  asio::error_code ignored;
  acceptor_.close(ignored);
  local_acceptor_.close(ignored);
  for (Connection* connection : shared_->connections) connection->close();
}

void HttpServer::disconnect_network(std::uint64_t except) {
  for (Connection* connection : shared_->connections) {
    if (!connection->local() && connection->number() != except) connection->close();
  }
}

tcp::endpoint parse_endpoint(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto wrong = [&] {
    return core::DataError("", "--listen", "\"" + text + "\" is not an address with a port",
                           "write for example 127.0.0.1:8377 or [::1]:8377");
  };
  if (colon == std::string::npos) throw wrong();
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (host == "localhost") host = "127.0.0.1";
  unsigned short port = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, port);
  asio::error_code bad;
  const auto address = asio::ip::make_address(host, bad);
  if (bad || error != std::errc() || stop != end) throw wrong();
  return {address, port};
}

}  // namespace unicursal::host
