#include "host/daemon/client.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <asio/connect.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/local/stream_protocol.hpp>
#include <asio/read.hpp>
#include <asio/write.hpp>
#include <cctype>
#include <charconv>
#include <string_view>

#include "host/daemon/state_folder.hpp"
#include "host/files/descriptor.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::seconds patience = 30s;
constexpr std::chrono::seconds connecting_patience = 10s;
constexpr std::chrono::seconds checking_patience =
    610s;  ///< for a job that is checked as long as --check-time allows at most
constexpr std::size_t longest_answer = 16 * 1024 * 1024;  ///< bytes

constexpr auto usual_port = "8377";

using Local = asio::local::stream_protocol;

/// Connects to the socket in the folder, whose name may be too long for an address.
bool connect(Local::socket& socket, const std::filesystem::path& state) {
  const Descriptor folder(::open(state.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return false;
  asio::error_code error;
  socket.connect(Local::endpoint(fmt::format("/proc/self/fd/{}/socket", folder.get())), error);
  return !error;
}

/// Sends, and reads until the server closes the connection. Throws asio::system_error.
template <typename Socket>
std::string exchange_on(asio::io_context& loop, Socket& socket, const std::string& request,
                        std::chrono::seconds longest) {
  std::string answer;
  asio::error_code problem;
  const auto finished = [&](const asio::error_code& error, std::size_t) { problem = error; };
  // An answer may come before everything is sent, so both happen at once.
  asio::async_write(socket, asio::buffer(request), [](const asio::error_code&, std::size_t) {});
  asio::async_read(socket, asio::dynamic_buffer(answer, longest_answer), asio::transfer_all(), finished);
  loop.restart();
  loop.run_for(longest);
  if (!loop.stopped()) throw asio::system_error(asio::error::timed_out);
  if (problem && problem != asio::error::eof && answer.empty()) throw asio::system_error(problem);
  return answer;
}

std::string talk_locally(const std::filesystem::path& state, const std::string& request,
                         std::chrono::seconds longest) {
  asio::io_context loop;
  Local::socket socket(loop);
  if (!connect(socket, state)) throw asio::system_error(asio::error::connection_refused);
  return exchange_on(loop, socket, request, longest);
}

std::string talk_to(const std::string& host, const std::string& port, const std::string& request,
                    std::chrono::seconds longest) {
  using asio::ip::tcp;
  asio::io_context loop;
  tcp::socket socket(loop);
  const auto places = tcp::resolver(loop).resolve(host, port);
  asio::error_code problem = asio::error::timed_out;
  asio::async_connect(socket, places,
                      [&](const asio::error_code& error, const tcp::endpoint&) { problem = error; });
  loop.run_for(connecting_patience);
  if (problem) throw asio::system_error(problem);
  return exchange_on(loop, socket, request, longest);
}

bool is_host_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("-._:").find(c) != std::string_view::npos;
}

bool is_graphic(char c) {
  return c > ' ' && c < 0x7f;
}

Answer parse_answer(const std::string& text, const DaemonError& strange) {
  constexpr std::string_view protocol = "HTTP/1.1 ";
  std::size_t end = text.find("\r\n\r\n");
  if (!text.starts_with(protocol) || end == std::string::npos) throw strange;
  Answer answer;
  const char* digits = text.data() + protocol.size();
  if (std::from_chars(digits, text.data() + text.size(), answer.status).ec != std::errc()) throw strange;
  answer.body = nlohmann::json::parse(text.substr(end + 4), nullptr, false);
  if (!answer.body.is_object()) throw strange;
  return answer;
}

}  // namespace

Client Client::at(const std::string& address, const std::optional<std::string>& token) {
  const auto refuse = [&](const char* problem, const char* remedy) {
    throw DaemonError("", "--daemon", "\"" + address + "\" " + problem, remedy);
  };
  constexpr auto example = "write for example http://printer.local:8377";
  std::string_view rest = address;
  constexpr std::string_view scheme = "http://";
  if (rest.starts_with("https://"))
    refuse("asks for TLS, which this program does not have",
           "use http:// inside your network, or a tunnel of SSH");
  if (rest.starts_with(scheme)) rest.remove_prefix(scheme.size());
  if (rest.ends_with('/')) rest.remove_suffix(1);
  Remote remote{"", usual_port, token.value_or("")};
  if (rest.starts_with('[')) {
    const std::size_t end = rest.find(']');
    if (end == std::string_view::npos) refuse("is not an address", example);
    remote.host = rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (!rest.empty() && !rest.starts_with(':')) refuse("is not an address", example);
  } else {
    remote.host = rest.substr(0, rest.find(':'));
    rest.remove_prefix(remote.host.size());
  }
  if (!rest.empty()) remote.port = rest.substr(1);
  unsigned short number = 0;
  const char* const end = remote.port.data() + remote.port.size();
  const auto [stop, error] = std::from_chars(remote.port.data(), end, number);
  if (remote.host.empty() || !std::all_of(remote.host.begin(), remote.host.end(), is_host_character) ||
      error != std::errc() || stop != end || number == 0)
    refuse("is not an address", example);
  if (!std::all_of(remote.token.begin(), remote.token.end(), is_graphic))
    throw DaemonError("", "--token", "has characters that a token cannot have",
                      "copy the text that `unicursal token` shows on the daemon's computer");
  return Client(std::variant<std::filesystem::path, Remote>(std::move(remote)));
}

std::optional<Client> Client::find(const std::filesystem::path& state) {
  asio::io_context loop;
  Local::socket socket(loop);
  if (!connect(socket, state)) return std::nullopt;
  return Client(std::variant<std::filesystem::path, Remote>(state));
}

Answer Client::ask(const std::string& method, const std::string& path) const {
  return exchange(method, path, "application/json", "");
}

Answer Client::ask(const std::string& method, const std::string& path, const nlohmann::json& body) const {
  return exchange(method, path, "application/json", body.dump());
}

Answer Client::send_file(const std::string& path, const std::string& bytes) const {
  return exchange("PUT", path, "application/octet-stream", bytes);
}

std::string Client::head(const std::string& method, const std::string& path, const std::string& type,
                         std::size_t length) const {
  std::string host = "localhost", proof;
  if (const auto* remote = std::get_if<Remote>(&daemon_)) {
    const bool brackets = remote->host.find(':') != std::string::npos;
    host = fmt::format("{}{}{}:{}", brackets ? "[" : "", remote->host, brackets ? "]" : "", remote->port);
    if (!remote->token.empty()) proof = "Authorization: Bearer " + remote->token + "\r\n";
  }
  return fmt::format(
      "{} {} HTTP/1.1\r\nHost: {}\r\n{}Connection: close\r\nContent-Type: {}\r\nContent-Length: {}\r\n\r\n",
      method, path, host, proof, type, length);
}

std::string Client::talk(const std::string& request, std::chrono::seconds longest) const {
  if (const auto* remote = std::get_if<Remote>(&daemon_))
    return talk_to(remote->host, remote->port, request, longest);
  return talk_locally(std::get<std::filesystem::path>(daemon_), request, longest);
}

std::string Client::place() const {
  if (const auto* remote = std::get_if<Remote>(&daemon_)) return remote->host + ":" + remote->port;
  return (std::get<std::filesystem::path>(daemon_) / "socket").string();
}

Answer Client::exchange(const std::string& method, const std::string& path, const std::string& type,
                        const std::string& body) const {
  const bool far = std::holds_alternative<Remote>(daemon_);
  try {
    const bool checked = method == "POST" && path == "/api/jobs";
    const std::string answer =
        talk(head(method, path, type, body.size()) + body, checked ? checking_patience : patience);
    return parse_answer(answer, {place(), "", "the program that answers there is not a unicursal daemon",
                                 far ? "correct the address and the port in --daemon"
                                     : "end it, and start one with `unicursal serve`"});
  } catch (const asio::system_error& error) {
    throw DaemonError(place(), "", "the daemon does not answer (" + error.code().message() + ")",
                      far ? "correct --daemon, or start it there with `unicursal serve --lan`"
                          : "start it with `unicursal serve`");
  }
}

}  // namespace unicursal::host
