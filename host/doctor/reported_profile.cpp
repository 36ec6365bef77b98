#include "host/doctor/reported_profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "firmware_gcode/print/per_feeder.hpp"
#include "host/engine/printer_check.hpp"

namespace unicursal::host {

std::string toml_list(const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) {
    std::string word = fmt::format("{:.10g}", value);
    if (word.find_first_of(".e") == std::string::npos) word += ".0";
    words.push_back(word);
  }
  return fmt::format("[{}]", fmt::join(words, ", "));
}

void note_reported(ProfileDraft& draft, const FoundPrinter& found, const gcode::Printer& frame) {
  const Examination& seen = found.examination;
  draft.set("printer", "port", toml_text(found.port));
  draft.set("printer", "baud", fmt::format("{}", found.baud));
  if (const auto firmware = dialect_of(seen.identity.family))
    draft.set("printer", "firmware", toml_text(*firmware));
  const auto limit = [&](const char* key, std::array<double, 3> values,
                         const std::optional<std::array<double, 4>>& reported) {
    if (!reported) return;
    for (std::size_t axis = 0; axis < values.size(); ++axis) {
      const double own = (*reported)[axis];
      if (own >= 0.1 && own < values[axis]) values[axis] = own;
    }
    draft.set("printer", key, toml_list({values.begin(), values.end()}));
  };
  limit("max_speed", frame.max_speed, seen.settings.max_speed);
  limit("max_acceleration", frame.max_acceleration, seen.settings.max_acceleration);
  std::optional<std::size_t> feeders = seen.feeders;
  if (seen.identity.family == gcode::Family::repetier) feeders = seen.identity.extruders;
  if (feeders && *feeders >= gcode::least_feeders && *feeders <= gcode::most_feeders)
    draft.set("extruder", "feeders", fmt::format("{}", *feeders));
}

}  // namespace unicursal::host
