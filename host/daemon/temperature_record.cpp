#include "host/daemon/temperature_record.hpp"

#include <chrono>
#include <cmath>
#include <optional>

namespace unicursal::host {
namespace {

using nlohmann::json;

json tenths(const std::optional<double>& temperature) {
  if (!temperature || !std::isfinite(*temperature)) return nullptr;
  return std::round(*temperature * 10) / 10;
}

}  // namespace

double unix_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// A clock that was set back begins a new record, since rows are in the order of time.
void TemperatureRecord::note(const gcode::Temperatures& known, double now) {
  if (!known.nozzle && !known.bed) return;
  const auto second = static_cast<std::int64_t>(std::floor(now));
  if (!rows_.empty() && second < rows_.back().second) rows_.clear();
  if (!rows_.empty() && second == rows_.back().second)
    rows_.back().known = known;
  else
    rows_.push_back({second, known});
  while (rows_.front().second <= second - longest) rows_.pop_front();
}

json TemperatureRecord::since(double since, double now) const {
  json rows = json::array();
  for (const Row& row : rows_) {
    if (static_cast<double>(row.second) <= since) continue;
    rows.push_back({row.second, tenths(row.known.nozzle), tenths(row.known.nozzle_target),
                    tenths(row.known.bed), tenths(row.known.bed_target)});
  }
  return {{"now", std::floor(now)},
          {"columns", {"time", "nozzle", "nozzle_target", "bed", "bed_target"}},
          {"rows", rows}};
}

}  // namespace unicursal::host
