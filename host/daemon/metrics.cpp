#include "host/daemon/metrics.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace unicursal::host {
namespace {

using nlohmann::json;

struct Gauge {
  const char* name;
  const char* help;
  const char* path;  ///< in the status
};

constexpr Gauge gauges[] = {
    {"unicursal_jobs_waiting", "Jobs that wait in the queue.", "/waiting"},
    {"unicursal_layer", "Layer that is being printed, from 1.", "/print/layer"},
    {"unicursal_layers", "Layers of the print.", "/print/layers"},
    {"unicursal_progress_percent", "Done, of the printing time.", "/print/percent"},
    {"unicursal_elapsed_seconds", "Since the print began.", "/print/elapsed_seconds"},
    {"unicursal_left_seconds", "Of printing, by the time model.", "/print/left_seconds"},
    {"unicursal_nozzle_celsius", "The nozzle's temperature.", "/print/nozzle/actual_c"},
    {"unicursal_nozzle_target_celsius", "What the nozzle is heated to.", "/print/nozzle/target_c"},
    {"unicursal_bed_celsius", "The bed's temperature.", "/print/bed/actual_c"},
    {"unicursal_bed_target_celsius", "What the bed is heated to.", "/print/bed/target_c"},
    {"unicursal_lookahead_seconds", "Of printing that are planned and not yet sent.",
     "/print/lookahead_seconds"},
    {"unicursal_queue_fill_ratio", "Of the printer's queue of moves, 0 to 1.", "/print/queue_fill"},
    {"unicursal_speed_percent", "Of the print's own speed.", "/print/speed_percent"},
    {"unicursal_flow_percent", "Of the print's own flow.", "/print/flow_percent"}};

std::string gauge(const char* name, const char* help, double value) {
  return fmt::format("# HELP {0} {1}\n# TYPE {0} gauge\n{0} {2:.10g}\n", name, help, value);
}

}  // namespace

std::string metrics_text(const json& status) {
  std::string text = gauge("unicursal_printing", "Whether a print is going on.",
                           status.value("state", "idle") == "idle" ? 0 : 1);
  const json::json_pointer print("/print/state");
  text += gauge("unicursal_paused", "Whether it is held.",
                status.contains(print) && status.at(print) == "paused" ? 1 : 0);
  for (const auto& [name, help, path] : gauges) {
    const json::json_pointer at{path};
    if (status.contains(at) && status.at(at).is_number())
      text += gauge(name, help, status.at(at).get<double>());
  }
  return text;
}

}  // namespace unicursal::host
