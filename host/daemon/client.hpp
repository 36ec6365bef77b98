// The commands' side of the API: connects to the socket in the daemon's state folder, sends a request, waits
// for the answer. The socket lives with its daemon, so that nobody else is spoken to, and the token is not
// needed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace unicursal::host {

struct Answer {
  int status = 0;
  nlohmann::json body;
};

class Client {
 public:
  /// Absent if no daemon runs there.
  static std::optional<Client> find(const std::filesystem::path& state);

  /// Blocks for at most half a minute, or ten minutes while a job is checked. Throws DaemonError if there is
  /// no answer, or another program answers.
  Answer ask(const std::string& method, const std::string& path) const;
  Answer ask(const std::string& method, const std::string& path, const nlohmann::json& body) const;
  Answer send_file(const std::string& path, const std::string& bytes) const;

 private:
  explicit Client(std::filesystem::path state) : state_(std::move(state)) {}
  Answer exchange(const std::string& method, const std::string& path, const std::string& type,
                  const std::string& body) const;

  std::filesystem::path state_;
};

}  // namespace unicursal::host
