#include "sim/motion/trapezoid.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

double reachable_speed(double end, double acceleration, double length) {
  return std::sqrt(end * end + 2 * acceleration * length);
}

double Trapezoid::peak() const {
  // Where the ramp up from `entry` meets the ramp down to `exit`.
  const double meeting = std::sqrt((entry * entry + exit * exit) / 2 + acceleration * length);
  return std::max({std::min(nominal, meeting), entry, exit});
}

double Trapezoid::seconds() const {
  const double top = peak();
  const double ramps = (2 * top * top - entry * entry - exit * exit) / (2 * acceleration);
  return (2 * top - entry - exit) / acceleration + std::max(0.0, length - ramps) / top;
}

double Trapezoid::distance(double time) const {
  const double top = peak(), total = seconds();
  if (time >= total) return length;
  const double rise = (top - entry) / acceleration, fall = (top - exit) / acceleration;
  if (time < rise) return entry * time + acceleration * time * time / 2;
  if (time < total - fall) return (entry + top) / 2 * rise + top * (time - rise);
  const double rest = total - time;
  return length - (exit * rest + acceleration * rest * rest / 2);
}

double Trapezoid::speed_at(double time) const {
  const double rising = entry + acceleration * time, falling = exit + acceleration * (seconds() - time);
  return std::min({rising, falling, peak()});
}

Trapezoid Trapezoid::part(double from, double to) const {
  return {distance(to) - distance(from), speed_at(std::max(from, 0.0)), nominal,
          speed_at(std::min(to, seconds())), acceleration};
}

}  // namespace unicursal::sim
