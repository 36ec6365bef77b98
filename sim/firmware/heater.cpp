#include "sim/firmware/heater.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {
constexpr double close_enough = 0.5;  // °C from the target at which it counts as reached
}

void Heater::set_target(double now, double target) {
  from_ = temperature(now);
  since_ = now;
  target_ = std::clamp(target, 0.0, model_.highest_target);
}

/// Where it settles: nothing here cools below the room.
double Heater::goal() const {
  return std::max(target_, room_temperature);
}

double Heater::temperature(double now) const {
  const bool heats = from_ < goal();
  const double end = heats ? model_.limit : room_temperature;
  const double free = end + (from_ - end) * std::exp((since_ - now) / model_.time_constant);
  return heats ? std::min(free, goal()) : std::max(free, goal());
}

int Heater::power(double now) const {
  constexpr int full = 127;
  if (target_ <= room_temperature) return 0;
  const double actual = temperature(now);
  if (actual < target_) return full;
  if (actual > target_) return 0;
  const double share = (target_ - room_temperature) / (model_.limit - room_temperature);
  return static_cast<int>(std::lround(full * share));
}

bool Heater::arrived(double now, bool heating_only) const {
  return arrival(now, heating_only) <= now;
}

double Heater::arrival(double now, bool heating_only) const {
  const double actual = temperature(now);
  const bool heats = actual < goal();
  const double reached = heats ? goal() - close_enough : goal() + close_enough;
  if (heats ? actual >= reached : heating_only || actual <= reached) return now;
  const double end = heats ? model_.limit : room_temperature;
  return now + model_.time_constant * std::log((actual - end) / (reached - end));
}

}  // namespace unicursal::sim
