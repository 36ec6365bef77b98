// A heater with its sensor, and the firmware's control of it. The block approaches the steady-state
// temperature of its power with one time constant; the sensor follows the block with another (sim/README.md,
// Physics). Between two steps of the control the power is constant, so every temperature has a closed-form
// solution and the clock can jump. °C, printer seconds.
//
// Control: full power far below the target, none far above, and in between Marlin's PID, which begins with an
// empty integral there. Its D, without the smoothing that the noise-free sensor of this model does not need,
// keeps a nozzle whose target was lowered from falling far below it. Protection as in Marlin 2.1 with its
// default periods: a heater that does not warm up, one that falls behind its target, and an impossible
// reading of the sensor.
#pragma once

#include <optional>

namespace unicursal::sim {

struct HeaterModel {
  double limit = 425;           ///< Steady-state temperature at full power, °C.
  double time_constant = 120;   ///< Time constant of the block, s.
  double highest_target = 260;  ///< The firmware limits higher targets to this, °C.
  double sensor_lag = 2;        ///< Time constant of the sensor, s.
  double gain = 0.06;           ///< Share of full power for each °C below the target.
  double integral_time = 20;    ///< s.
  double damping = 0.4;  ///< Share of full power for each °C/s by which it falls (Marlin's DEFAULT_Kd ÷ 255).
  double watch_period = 40;    ///< Time within which it must warm up by 2 °C, s.
  double runaway_period = 40;  ///< Time for which it may be behind its target, s.
  double runaway_margin = 4;   ///< Difference from the target that counts as behind, °C.
  double max_temp = 275;       ///< Above this the firmware stops everything, °C.

  static HeaterModel bed();
};

inline constexpr double room_temperature = 25;  ///< °C

class Heater {
 public:
  /// Alarms of the protection.
  enum class Alarm { heating_failed, thermal_runaway, min_temp, max_temp };
  enum class Defect {
    none,
    open,    ///< The cartridge gives no heat.
    closed,  ///< The transistor does not switch off.
  };

  explicit Heater(const HeaterModel& model) : model_(model) {}

  void set_target(double now, double target);
  double target() const { return target_; }
  /// The reading of the sensor.
  double temperature(double now) const;
  /// The temperature of the block itself.
  double block(double now) const;
  /// Power in the firmware's units, 0…127.
  int power() const { return power_; }

  /// The time of the control's next step; nullopt if there is nothing to control.
  std::optional<double> next_tick() const;
  /// Runs the control if it is due, and returns its alarm, if any.
  std::optional<Alarm> tick(double now);

  /// Whether a wait may end: near the target, or, with `heating_only`, not below it.
  bool arrived(double now, bool heating_only) const;
  /// Whether it is so far from the target that a wait must start again.
  bool strayed(double now) const;

  void break_down(double now, Defect defect);
  void pull_thermistor(double now);
  /// From now on no alarm is raised, as in a firmware that was built without protection.
  void leave_unguarded() { guarded_ = false; }
  /// Board reset: clears target and protection state; keeps temperature and defects.
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
  bool guarded_ = true;
  double target_ = 0;
  int power_ = 0;
  double integral_ = 0;                              ///< Share of full power.
  std::optional<double> last_reading_;               ///< One period ago.
  double since_ = 0;                                 ///< Time of the last change of power.
  Sample from_{room_temperature, room_temperature};  ///< Temperatures at that time.
  double tick_at_ = 0;
  std::optional<double> watch_until_;  ///< It must have reached `watch_goal_` by then.
  double watch_goal_ = 0;              ///< °C.
  bool reached_ = false;               ///< Whether it has reached the target once.
  std::optional<double> behind_since_;
};

/// The alarm in Marlin 2.1's words, such as "Thermal Runaway".
const char* sentence(Heater::Alarm alarm);

}  // namespace unicursal::sim
