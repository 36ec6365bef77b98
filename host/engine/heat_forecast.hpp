// How long the printer will still heat, from the temperatures that it reports. °C, s. No I/O.
//
// A heater goes on at the rate at which it has risen lately; before that is known, at a usual one. It rises
// ever more slowly near its target, which the forecast leaves out. Heaters that are on heat side by side; one
// whose target the firmware does not report yet begins when the others are hot.
#pragma once

#include <deque>
#include <optional>

#include "firmware_gcode/reply/reply.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

/// One heater.
class HeaterForecast {
 public:
  /// `usual_rate`, °C/s, of heaters of this kind.
  explicit HeaterForecast(double usual_rate) : usual_rate_(usual_rate) {}

  /// Takes a report of the temperature.
  void note(TimePoint at, double reading);
  /// s until it has reached `target`, from the last report on; 0 if it has, or has not been reported.
  double left(double target) const;

 private:
  struct Mark {
    TimePoint at;
    double reading;
  };

  double usual_rate_;
  std::deque<Mark> marks_;  ///< of the last seconds, oldest first
};

/// Nozzle and bed.
class HeatForecast {
 public:
  HeatForecast();
  /// Takes a report.
  void note(TimePoint at, const gcode::Temperatures& reported);
  /// s until both have the targets that the print has set.
  double left(double nozzle, double bed) const;

 private:
  gcode::Temperatures last_;
  HeaterForecast nozzle_, bed_;
};

}  // namespace unicursal::host
