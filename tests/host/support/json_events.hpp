// Events that a print writes with --json.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

namespace unicursal::test {

/// The mixtures that the events name while the state is "printing".
inline std::set<std::string> mixtures_named(const std::string& events) {
  std::set<std::string> mixtures;
  std::istringstream lines(events);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('{')) continue;
    const nlohmann::json status = nlohmann::json::parse(line).value("status", nlohmann::json::object());
    if (status.value("state", "") == "printing" && status.contains("mixture"))
      mixtures.insert(status["mixture"].get<std::string>());
  }
  return mixtures;
}

}  // namespace unicursal::test
