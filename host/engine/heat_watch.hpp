// Watches the heat of nozzle and bed while the printer prints. Firmwares watch it as well, but let a nozzle
// cool for up to 40 s (Marlin's THERMAL_PROTECTION_PERIOD), and Repetier then drives on without plastic
// (MIN_EXTRUDER_TEMP in its Configuration.h) and says nothing. °C, s. No I/O.
//
// A heater has a *level*: its target, or less while it still warms up after a change. It is too cold if it is
// far below its level for some time, or has fallen without a pause and far enough that nothing can be heating
// it. During the print's own waits for heat call rest(); WarmUpWatch looks after those.
#pragma once

#include <optional>
#include <string>

#include "firmware_gcode/reply/reply.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

enum class HeatTrouble {
  cold,  ///< it loses its heat, or has lost it
  off,   ///< the firmware has switched it off by itself
  hot    ///< it becomes hotter than it should be
};

/// One heater.
class HeaterWatch {
 public:
  struct Rules {
    double behind;  ///< below the level, for as long as `patience`: too cold
    double fallen;  ///< below the level, after a fall without a pause of at least `rate`: not heated any more
    double rate;    ///< °C/s
    double beyond;  ///< above the target, for as long as `patience`, and rising: too hot
  };
  explicit HeaterWatch(const Rules& rules) : rules_(rules) {}

  /// Takes a report. `wanted`: the target that the print has set; 0: off. `reported`: the one that the
  /// firmware reports. A person may have changed it at the printer's display, which is respected.
  std::optional<HeatTrouble> note(TimePoint at, double reading, std::optional<double> reported,
                                  double wanted);
  /// Begins again with the next report.
  void rest() { *this = HeaterWatch(rules_); }

 private:
  bool is_off(TimePoint at, std::optional<double> reported, double wanted);
  void raise_level(double reading, double target);
  bool is_cold(TimePoint at, double reading);
  bool is_hot(TimePoint at, double reading);

  struct Mark {
    TimePoint at;
    double reading;
  };

  Rules rules_;
  double wanted_ = 0;
  bool confirmed_ = false;  ///< the firmware has reported a target since `wanted_` was set
  std::optional<double> target_;
  double level_ = 0;
  double last_ = 0;                 ///< reading
  std::optional<Mark> falls_from_;  ///< since then every reading was lower than the one before
  std::optional<TimePoint> behind_since_, off_since_;
  std::optional<Mark> beyond_since_;
};

/// Nozzle and bed.
class HeatWatch {
 public:
  struct Trouble {
    HeatTrouble what{};
    std::string why;     ///< a sentence with the remedy
    bool meant = false;  ///< a person may have done it at the printer: the print goes on
  };

  HeatWatch();
  /// Takes a report; the targets are those that the print has set.
  std::optional<Trouble> note(TimePoint at, const gcode::Temperatures& reported, double nozzle, double bed);
  void rest();

 private:
  HeaterWatch nozzle_, bed_;
};

/// Watches a wait for heat: a heater must become warmer. Firmwares watch this, too (Marlin's
/// WATCH_TEMP_PERIOD of 40 s and WATCH_BED_TEMP_PERIOD of 60 s, each for 2 °C), unless they were built
/// without it; then M109 waits without end.
class WarmUpWatch {
 public:
  /// Returns a sentence with the remedy if a heater gives no heat. `nozzle` and `bed` are the targets that
  /// the print has set; they count where the firmware reports none, as Repetier does in its waits.
  std::optional<std::string> note(TimePoint at, const gcode::Temperatures& reported, double nozzle,
                                  double bed);
  void rest() { *this = WarmUpWatch(); }

 private:
  struct Climb {
    double target = 0;
    double highest = 0;  ///< reading
    TimePoint since;     ///< it was reached
  };
  std::optional<Climb> nozzle_, bed_;
};

}  // namespace unicursal::host
