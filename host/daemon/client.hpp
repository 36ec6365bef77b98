// The commands' side of the API: sends a request to a daemon and waits for the answer. A daemon of this user
// is reached by the socket in its state folder, which lives with its daemon, so that nobody else is spoken
// to, and needs no token. Another computer's is reached over TCP, with its token; the line has no TLS, so
// that whoever can listen on the network in between can read the token.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

namespace unicursal::host {

struct Answer {
  int status = 0;
  nlohmann::json body;
};

class Client {
 public:
  /// Absent if no daemon runs there.
  static std::optional<Client> find(const std::filesystem::path& state);
  /// At an address such as "http://printer.local:8377" or "192.168.1.5"; absent port: 8377. Throws
  /// DaemonError if that is not an address; nothing is connected yet.
  static Client at(const std::string& address, const std::optional<std::string>& token);

  /// Blocks for at most half a minute, or ten minutes while a job is checked. Throws DaemonError if there is
  /// no answer, or another program answers.
  Answer ask(const std::string& method, const std::string& path) const;
  Answer ask(const std::string& method, const std::string& path, const nlohmann::json& body) const;
  Answer send_file(const std::string& path, const std::string& bytes) const;

 private:
  struct Remote {
    std::string host, port;  ///< a name, or an address without brackets
    std::string token;       ///< may be empty
  };

  explicit Client(std::variant<std::filesystem::path, Remote> daemon) : daemon_(std::move(daemon)) {}
  std::string head(const std::string& method, const std::string& path, const std::string& type,
                   std::size_t length) const;
  std::string talk(const std::string& request, std::chrono::seconds longest) const;
  std::string place() const;
  Answer exchange(const std::string& method, const std::string& path, const std::string& type,
                  const std::string& body) const;

  std::variant<std::filesystem::path, Remote> daemon_;  ///< a state folder, or another computer
};

}  // namespace unicursal::host
