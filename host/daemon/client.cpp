#include "host/daemon/client.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <asio/io_context.hpp>
#include <asio/local/stream_protocol.hpp>
#include <asio/read.hpp>
#include <asio/write.hpp>
#include <charconv>

#include "host/daemon/state_folder.hpp"
#include "host/files/descriptor.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::seconds patience = 30s;
constexpr std::chrono::seconds checking_patience =
    610s;  ///< for a job that is checked as long as --check-time allows at most
constexpr std::size_t longest_answer = 16 * 1024 * 1024;  ///< bytes

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
std::string talk(const std::filesystem::path& state, const std::string& request,
                 std::chrono::seconds longest) {
  asio::io_context loop;
  Local::socket socket(loop);
  if (!connect(socket, state)) throw asio::system_error(asio::error::connection_refused);
  std::string answer;
  asio::error_code problem;
  const auto finished = [&](const asio::error_code& error, std::size_t) { problem = error; };
  // An answer may come before everything is sent, so both happen at once.
  asio::async_write(socket, asio::buffer(request), [](const asio::error_code&, std::size_t) {});
  asio::async_read(socket, asio::dynamic_buffer(answer, longest_answer), asio::transfer_all(), finished);
  loop.run_for(longest);
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
  asio::io_context loop;
  Local::socket socket(loop);
  if (!connect(socket, state)) return std::nullopt;
  return Client(state);
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
  const std::string request = fmt::format(
      "{} {} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Type: {}\r\nContent-Length: "
      "{}\r\n\r\n",
      method, path, type, body.size());
  const std::string socket = (state_ / "socket").string();
  try {
    const bool checked = method == "POST" && path == "/api/jobs";
    return parse_answer(talk(state_, request + body, checked ? checking_patience : patience),
                        {socket, "", "the program that answers there is not a unicursal daemon",
                         "end it, and start one with `unicursal serve`"});
  } catch (const asio::system_error& error) {
    throw DaemonError(socket, "", "the daemon does not answer (" + error.code().message() + ")",
                      "start it with `unicursal serve`");
  }
}

}  // namespace unicursal::host
