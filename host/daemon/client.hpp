// The commands' side of the API: finds the daemon by its state folder, sends a request, waits for the answer.
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
  /// Absent if no daemon has left its address there.
  static std::optional<Client> find(const std::filesystem::path& state);

  /// Blocks for at most half a minute. Throws DaemonError if there is no answer, or another program answers.
  Answer ask(const std::string& method, const std::string& path) const;
  Answer ask(const std::string& method, const std::string& path, const nlohmann::json& body) const;
  Answer send_file(const std::string& path, const std::string& bytes) const;

 private:
  Client(std::filesystem::path state, std::string address, std::optional<std::string> token)
      : state_(std::move(state)), address_(std::move(address)), token_(std::move(token)) {}
  Answer exchange(const std::string& method, const std::string& path, const std::string& type,
                  const std::string& body) const;

  std::filesystem::path state_;
  std::string address_;
  std::optional<std::string> token_;
};

}  // namespace unicursal::host
