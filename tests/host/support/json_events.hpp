// Events that a print writes with --json.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace unicursal::test {

/// The statuses of the events while the state is "printing", in order.
inline std::vector<nlohmann::json> printing_statuses(const std::string& events) {
  std::vector<nlohmann::json> statuses;
  std::istringstream lines(events);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('{')) continue;
    nlohmann::json status = nlohmann::json::parse(line).value("status", nlohmann::json::object());
    if (status.value("state", "") == "printing") statuses.push_back(std::move(status));
  }
  return statuses;
}

/// The mixtures that the events name while the state is "printing", without the feeders that purge their
/// inlets before the part.
inline std::set<std::string> mixtures_named(const std::string& events) {
  std::set<std::string> mixtures;
  for (const nlohmann::json& status : printing_statuses(events)) {
    const std::string mixture = status.value("mixture", "");
    if (!mixture.empty() && !mixture.starts_with("feeder ")) mixtures.insert(mixture);
  }
  return mixtures;
}

}  // namespace unicursal::test
