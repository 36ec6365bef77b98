// A heater with its thermometer and the firmware's control of it. The block warms towards the temperature
// that its power gives in the long run, with one time constant; the thermometer follows the block with
// another. Between two ticks of the control the power is constant, so every temperature has a closed form and
// the clock may jump. °C, printer seconds.
//
// Control: full power while far below the target, none while far above, between them proportional and
// integral (Marlin's PID without its D, which the model's clean thermometer does not need). Protection as in
// Marlin 2.1 with its default periods: a heater that does not warm, one that falls behind its target, and a
// thermometer that reads what cannot be.
#pragma once

#include <optional>

namespace unicursal::sim {

struct HeaterModel {
  double limit = 425;           ///< °C reached at full power after a long time
  double time_constant = 120;   ///< s
  double highest_target = 260;  ///< the firmware cuts higher targets down to this
  double sensor_lag = 2;        ///< s
  double gain = 0.06;           ///< share of full power for each °C below the target
  double integral_time = 20;    ///< s
  double watch_period = 40;     ///< s within which it must have warmed by 2 °C
  double runaway_period = 40;   ///< s that it may be behind its target
  double runaway_margin = 4;    ///< °C behind the target that count
  double max_temp = 275;        ///< °C: above, the firmware stops everything

  static HeaterModel bed();
};

inline constexpr double room_temperature = 25;  ///< °C

class Heater {
 public:
  /// What the protection has found.
  enum class Alarm { heating_failed, thermal_runaway, min_temp, max_temp };
  /// What can break.
  enum class Defect {
    none,
    open,    ///< the cartridge gives no heat
    closed,  ///< its transistor does not switch off
  };

  explicit Heater(const HeaterModel& model) : model_(model) {}

  void set_target(double now, double target);
  double target() const { return target_; }
  /// What the firmware reads.
  double temperature(double now) const;
  /// Of the block itself.
  double block(double now) const;
  /// Firmware's measure of power, 0…127.
  int power() const { return power_; }

  /// When the control next acts; nothing when there is nothing to control.
  std::optional<double> next_tick() const;
  /// Lets the control act if it is due.
  std::optional<Alarm> tick(double now);

  /// Whether a wait may end: `heating_only` waits only while it is too cold, otherwise for both.
  bool arrived(double now, bool heating_only) const;
  /// It has been there and has left again.
  bool strayed(double now) const;

  void break_down(double now, Defect defect);
  void pull_thermistor(double now);
  /// The board resets: no target, full of hope. Heat and defects stay.
  void reset(double now);

 private:
  struct Sample {
    double block, sensor;
  };
  Sample at(double now) const;
  double delivered() const;
  void set_power(double now, int power);
  int wanted(double reading);
  std::optional<Alarm> protect(double now, double reading);
  void start_watch(double now);

  HeaterModel model_;
  Defect defect_ = Defect::none;
  bool pulled_ = false;
  double target_ = 0;
  int power_ = 0;
  double integral_ = 0;                              ///< share of full power
  double since_ = 0;                                 ///< of the present power
  Sample from_{room_temperature, room_temperature};  ///< then
  double tick_at_ = 0;
  std::optional<double> watch_until_;  ///< must have warmed by then
  double watch_goal_ = 0;              ///< °C
  bool reached_ = false;               ///< the target, once
  std::optional<double> behind_since_;
};

/// "Thermal Runaway, system stopped! Heater_ID: 0", as Marlin 2.1 words it. `id`: "0" or "bed".
const char* sentence(Heater::Alarm alarm);

}  // namespace unicursal::sim
