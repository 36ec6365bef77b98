#include "host/daemon/client.hpp"

#include <fmt/format.h>

#include <asio/connect.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/read.hpp>
#include <asio/write.hpp>
#include <charconv>

#include "host/daemon/state_folder.hpp"
#include "host/http/http_server.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto patience = 30s;
constexpr std::size_t longest_answer = 16 * 1024 * 1024;  ///< bytes

/// Sends, and reads until the server closes the connection. Throws asio::system_error.
std::string talk(const asio::ip::tcp::endpoint& at, const std::string& request) {
  asio::io_context loop;
  asio::ip::tcp::socket socket(loop);
  std::string answer;
  asio::error_code problem;
  const auto finished = [&](const asio::error_code& error, std::size_t) { problem = error; };
  socket.async_connect(at, [&](const asio::error_code& error) {
    problem = error;
    if (error) return;
    // An answer may come before everything is sent, so both happen at once.
    asio::async_write(socket, asio::buffer(request), [](const asio::error_code&, std::size_t) {});
    asio::async_read(socket, asio::dynamic_buffer(answer, longest_answer), asio::transfer_all(), finished);
  });
  loop.run_for(patience);
  if (!loop.stopped()) throw asio::system_error(asio::error::timed_out);
  if (problem && problem != asio::error::eof && answer.empty()) throw asio::system_error(problem);
  return answer;
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

std::optional<Client> Client::find(const std::filesystem::path& state) {
  const auto address = read_line(state / "address");
  if (!address) return std::nullopt;
  return Client(state, *address, read_line(state / "token"));
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

Answer Client::exchange(const std::string& method, const std::string& path, const std::string& type,
                        const std::string& body) const {
  std::string request = fmt::format(
      "{} {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Type: {}\r\nContent-Length: {}\r\n", method,
      path, address_, type, body.size());
  if (token_) request += "Authorization: Bearer " + *token_ + "\r\n";
  try {
    const std::string answer = talk(parse_endpoint(address_), request + "\r\n" + body);
    return parse_answer(answer,
                        {address_, "", "the program that answers there is not a unicursal daemon",
                         "start one with `unicursal serve`, or delete " + (state_ / "address").string()});
  } catch (const asio::system_error& error) {
    throw DaemonError(address_, "", "the daemon does not answer (" + error.code().message() + ")",
                      "start it with `unicursal serve`");
  }
}

}  // namespace unicursal::host
