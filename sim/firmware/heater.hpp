// A heater with its thermometer, to first order: at full power the temperature creeps towards a limit,
// unheated towards the room; at the target it is held exactly. Every question has a closed answer, so the
// clock may jump. °C, printer seconds.
#pragma once

#include <optional>

namespace unicursal::sim {

struct HeaterModel {
  double limit = 425;           ///< °C reached at full power after a long time
  double time_constant = 120;   ///< s
  double highest_target = 260;  ///< the firmware cuts higher targets down to this
};

inline constexpr double room_temperature = 25;  ///< °C

class Heater {
 public:
  explicit Heater(const HeaterModel& model) : model_(model) {}

  void set_target(double now, double target);
  double target() const { return target_; }
  double temperature(double now) const;
  /// Firmware's measure of power, 0…127.
  int power(double now) const;

  /// Whether a wait is over: `heating` waits only while it is too cold, otherwise for both.
  bool arrived(double now, bool heating_only) const;
  /// When it will be over.
  double arrival(double now, bool heating_only) const;

 private:
  double goal() const;

  HeaterModel model_;
  double target_ = 0;
  double since_ = 0, from_ = room_temperature;  ///< the last change of target
};

}  // namespace unicursal::sim
