// Chance that is the same everywhere: the standard library's generators are fixed, its distributions are not.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace unicursal::camera {

/// Scattered like a normal distribution with mean 0 and deviation 1. Two numbers come from each draw.
class NormalChance {
 public:
  explicit NormalChance(std::uint32_t seed) : chance_(seed) {}

  float operator()() {
    if (waits_) {
      waits_ = false;
      return quantiles()[drawn_ >> 16];
    }
    drawn_ = static_cast<std::uint32_t>(chance_());
    waits_ = true;
    return quantiles()[drawn_ & 0xffff];
  }

 private:
  static constexpr std::size_t count = 65536;

  /// In ascending order, from the density summed up in small steps.
  static const std::array<float, count>& quantiles() {
    static const std::array<float, count> table = [] {
      std::array<float, count> made{};
      const double step = 1e-5, scale = 1 / std::sqrt(2 * std::acos(-1.0));
      double x = -6, below = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const double wanted = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        while (below < wanted && x < 6) {
          below += step * scale * std::exp(-(x + step / 2) * (x + step / 2) / 2);
          x += step;
        }
        made[i] = static_cast<float>(x);
      }
      return made;
    }();
    return table;
  }

  std::mt19937 chance_;
  std::uint32_t drawn_ = 0;
  bool waits_ = false;
};

/// A whole number that looks like chance but depends on nothing but its arguments.
inline std::uint32_t scrambled(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^
                    static_cast<std::uint32_t>(y) * 0xd8163841U ^ seed * 0xcb1ab31fU;
  h ^= h >> 13;
  h *= 0x5bd1e995U;
  h ^= h >> 15;
  h *= 0x2c1b3c6dU;
  return h ^ h >> 16;
}

/// Smooth chance over the plane, 0 to 1; it changes over a distance of 1.
inline double rippled(double x, double y, std::uint32_t seed) {
  const double left = std::floor(x), bottom = std::floor(y);
  const auto column = static_cast<std::int32_t>(left), row = static_cast<std::int32_t>(bottom);
  const double u = x - left, v = y - bottom;
  const auto corner = [&](std::int32_t dx, std::int32_t dy) {
    return static_cast<double>(scrambled(column + dx, row + dy, seed)) / 4294967295.0;
  };
  const double lower = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  const double upper = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return lower + v * (upper - lower);
}

}  // namespace unicursal::camera
