#include "host/report/print_report.hpp"

#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "host/engine/print.hpp"
#include "host/engine/session_json.hpp"

namespace unicursal::host {

void conclude(Books& books, const StreamResult& result, const nlohmann::json& extra) {
  nlohmann::json rest = {{"ended", name(result.ending)}, {"link", link_json(result)}};
  if (result.ending == Ending::failed) rest["reason"] = result.reason;
  rest.update(extra);
  std::string problem;
  try {
    books.write_report(rest);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  throw_if_failed(result);
  if (!problem.empty()) {
    throw PrintError(
        fmt::format("the print was {}, but its report is lost: {}", name(result.ending), problem));
  }
}

nlohmann::json planning_json(const Planning& planning) {
  return {{"seconds", planning.effort.seconds},
          {"cpu_seconds", planning.effort.cpu_seconds},
          {"threads", planning.threads}};
}

nlohmann::json link_json(const StreamResult& result) {
  const LinkStatistics& s = result.statistics;
  return {{"firmware", result.firmware},
          {"lines", s.lines},
          {"sent", s.sent},
          {"acknowledged", s.acknowledged},
          {"resends", s.resends},
          {"bytes", s.bytes},
          {"probes", s.probes},
          {"queries", s.queries},
          {"recounts", s.recounts}};
}

}  // namespace unicursal::host
