// The temperatures of the last hour, one row for each second in which the printer has reported some, so that
// a chart does not begin empty. Whoever hears of temperatures notes them, during a print and while the
// printer is idle alike:
//
//   daemon.temperature_record().note(link.temperatures());
//
// It belongs to the loop's thread. °C, unix seconds.
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>

#include "firmware_gcode/reply/reply.hpp"

namespace unicursal::host {

/// Seconds since 1970.
double unix_seconds();

class TemperatureRecord {
 public:
  static constexpr std::int64_t longest = 3600;  ///< s that are kept

  /// As known at `now`; what is unknown is absent. Of one second the last counts.
  void note(const gcode::Temperatures& known, double now = unix_seconds());
  /// {"now", "columns", "rows"}: the rows behind the second `since`, as API.md has them.
  nlohmann::json since(double since, double now = unix_seconds()) const;

 private:
  struct Row {
    std::int64_t second = 0;
    gcode::Temperatures known;
  };
  std::deque<Row> rows_;  ///< the oldest first
};

}  // namespace unicursal::host
