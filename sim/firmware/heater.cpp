#include "sim/firmware/heater.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace unicursal::sim {

namespace {
constexpr int full = 127;
constexpr double period = 0.25;        // s between two steps of the control
constexpr double control_range = 10;   // °C from the target, beyond which power is all or nothing
constexpr double window = 1;           // °C from the target that count as reached
constexpr double hysteresis = 3;       // °C from the target that count as strayed
constexpr double watch_increase = 2;   // °C
constexpr double min_temp = 5;         // °C: a lower reading means a missing thermistor
constexpr double no_thermistor = -15;  // °C: the reading of an open input
}  // namespace

HeaterModel HeaterModel::bed() {
  HeaterModel model{175, 300, 140};
  model.sensor_lag = 5;
  model.gain = 0.4;  // holds it within the runaway margin before the integral has grown
  model.integral_time = 60;
  model.damping = 0;
  model.watch_period = 60;
  model.runaway_period = 20;
  model.runaway_margin = 2;
  model.max_temp = 150;
  return model;
}

/// Share of full power that the heater really delivers.
double Heater::delivered() const {
  if (defect_ == Defect::open) return 0;
  if (defect_ == Defect::closed) return 1;
  return static_cast<double>(power_) / full;
}

// With the block's b(t) = end + (b0 − end) e^(−t/τ), the sensor's s' = (b − s)/λ has this solution.
Heater::Sample Heater::at(double now) const {
  const double end = room_temperature + delivered() * (model_.limit - room_temperature);
  const double passed = now - since_;
  const double block = (from_.block - end) * std::exp(-passed / model_.time_constant);
  const double share = model_.time_constant / (model_.time_constant - model_.sensor_lag);
  const double lagging =
      (from_.sensor - end - (from_.block - end) * share) * std::exp(-passed / model_.sensor_lag);
  return {end + block, end + block * share + lagging};
}

double Heater::temperature(double now) const {
  return pulled_ ? no_thermistor : at(now).sensor;
}

double Heater::block(double now) const {
  return at(now).block;
}

void Heater::set_power(double now, int power) {
  from_ = at(now);
  since_ = now;
  power_ = power;
}

void Heater::set_target(double now, double target) {
  target = std::clamp(target, 0.0, model_.highest_target);
  if (target != target_) {
    reached_ = false;
    behind_since_.reset();
  }
  if (target == 0) integral_ = 0;  // Marlin keeps it as long as the reading is near the target
  target_ = target;
  last_reading_.reset();
  start_watch(now);
  set_power(now, wanted(temperature(now)));
  tick_at_ = now + period;
}

/// As in Marlin, only a heater that is well below its target is watched.
void Heater::start_watch(double now) {
  watch_until_.reset();
  const double reading = temperature(now);
  if (target_ <= reading + watch_increase + hysteresis) return;
  watch_goal_ = reading + watch_increase;
  watch_until_ = now + model_.watch_period;
}

std::optional<double> Heater::next_tick() const {
  if (target_ > 0 || pulled_ || defect_ == Defect::closed) return tick_at_;
  return std::nullopt;
}

std::optional<Heater::Alarm> Heater::tick(double now) {
  if (!next_tick() || now < tick_at_) return std::nullopt;
  tick_at_ = now + period;
  const double reading = temperature(now);
  set_power(now, wanted(reading));
  return guarded_ ? protect(now, reading) : std::nullopt;
}

int Heater::wanted(double reading) {
  const double falls = (std::exchange(last_reading_, reading).value_or(reading) - reading) / period;  // °C/s
  if (target_ <= 0) return 0;
  const double error = target_ - reading;
  if (std::abs(error) > control_range) {
    integral_ = 0;
    return error > 0 ? full : 0;
  }
  integral_ = std::clamp(integral_ + model_.gain * error * period / model_.integral_time, 0.0, 1.0);
  return static_cast<int>(
      std::lround(full * std::clamp(model_.gain * error + integral_ + model_.damping * falls, 0.0, 1.0)));
}

std::optional<Heater::Alarm> Heater::protect(double now, double reading) {
  if (reading < min_temp) return Alarm::min_temp;
  if (reading > model_.max_temp) return Alarm::max_temp;
  if (target_ <= 0) return std::nullopt;
  if (reading >= target_ - model_.runaway_margin) {
    reached_ = true;
    behind_since_.reset();
    watch_until_.reset();
  } else if (reached_ && !behind_since_) {
    behind_since_ = now;
  }
  if (behind_since_ && now - *behind_since_ > model_.runaway_period) return Alarm::thermal_runaway;
  if (watch_until_ && now >= *watch_until_) {
    if (reading < watch_goal_) return Alarm::heating_failed;
    start_watch(now);
  }
  return std::nullopt;
}

bool Heater::arrived(double now, bool heating_only) const {
  const double away = temperature(now) - std::max(target_, room_temperature);
  return heating_only ? away > -window : std::abs(away) < window;
}

bool Heater::strayed(double now) const {
  return std::abs(temperature(now) - std::max(target_, room_temperature)) > hysteresis;
}

void Heater::break_down(double now, Defect defect) {
  set_power(now, power_);
  defect_ = defect;
  tick_at_ = std::max(tick_at_, now);
}

void Heater::pull_thermistor(double now) {
  pulled_ = true;
  tick_at_ = std::max(tick_at_, now);
}

void Heater::reset(double now) {
  set_target(now, 0);
  set_power(now, 0);
}

const char* sentence(Heater::Alarm alarm) {
  switch (alarm) {
    case Heater::Alarm::heating_failed:
      return "Heating failed";
    case Heater::Alarm::thermal_runaway:
      return "Thermal Runaway";
    case Heater::Alarm::min_temp:
      return "MINTEMP triggered";
    case Heater::Alarm::max_temp:
      return "MAXTEMP triggered";
  }
  assert(false);
  return "";
}

}  // namespace unicursal::sim
