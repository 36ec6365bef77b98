#include "host/engine/session_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace unicursal::host {
namespace {

using nlohmann::json;

void add_if_known(json& to, const char* key, const std::optional<double>& value) {
  if (value) to[key] = *value;
}

json heater(const std::optional<double>& actual, const std::optional<double>& target,
            const std::optional<double>& job) {
  json heater = json::object();
  add_if_known(heater, "actual_c", actual);
  add_if_known(heater, "target_c", target);
  add_if_known(heater, "job_c", job);
  return heater;
}

}  // namespace

const char* name(Ending ending) {
  switch (ending) {
    case Ending::completed:
      return "completed";
    case Ending::stopped:
      return "stopped";
    case Ending::failed:
      break;
  }
  return "failed";
}

json to_json(const SessionStatus& s) {
  json status = {{"state", name(s.state)},
                 {"layer", s.layer},
                 {"layers", s.layers},
                 {"percent", s.percent},
                 {"elapsed_seconds", s.elapsed},
                 {"nozzle", heater(s.temperatures.nozzle, s.temperatures.nozzle_target, s.job_nozzle)},
                 {"bed", heater(s.temperatures.bed, s.temperatures.bed_target, s.job_bed)},
                 {"lookahead_seconds", s.lookahead},
                 {"lookahead_layers", s.lookahead_layers},
                 {"speed_percent", s.speed_percent},
                 {"flow_percent", s.flow_percent},
                 {"warnings", s.warnings}};
  add_if_known(status, "left_seconds", s.left);
  add_if_known(status, "queue_fill", s.queue);
  if (!s.mixture.empty()) status["mixture"] = s.mixture;
  if (!s.reason.empty()) status["reason"] = s.reason;
  if (s.prompt) status["prompt"] = {{"text", s.prompt->text}, {"answers", s.prompt->answers}};
  return status;
}

json to_json(const SessionEvent& event, const SessionStatus& status) {
  json result = {{"event", name(event.kind)}, {"status", to_json(status)}};
  if (!event.text.empty()) result["text"] = event.text;
  return result;
}

}  // namespace unicursal::host
