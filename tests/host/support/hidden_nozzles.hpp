// Nozzles whose volumes a tuning has to find: 20 by chance, always the same.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace unicursal::test {

struct HiddenNozzle {
  double dead = 0, mixing = 0;  ///< mm³
  std::size_t tanks = 1;
};

inline constexpr double least_dead = 0.5, most_dead = 15, least_mixing = 1.5, most_mixing = 25;
inline constexpr std::size_t most_tanks = 6;

/// Distributions of the standard library differ between its makers; its generators do not.
inline HiddenNozzle hidden_nozzle(std::mt19937& chance) {
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(chance()) / 4294967295.0;
  };
  HiddenNozzle nozzle;
  nozzle.dead = between(least_dead, most_dead);
  nozzle.mixing = between(least_mixing, most_mixing);
  nozzle.tanks = 1 + chance() % most_tanks;
  return nozzle;
}

inline std::vector<HiddenNozzle> hidden_nozzles(std::size_t count = 20, unsigned seed = 5) {
  std::mt19937 chance(seed);
  std::vector<HiddenNozzle> nozzles;
  while (nozzles.size() < count) nozzles.push_back(hidden_nozzle(chance));
  return nozzles;
}

/// The least and the greatest of everything.
inline std::vector<HiddenNozzle> extreme_nozzles() {
  std::vector<HiddenNozzle> nozzles;
  for (const double dead : {least_dead, most_dead}) {
    for (const double mixing : {least_mixing, most_mixing}) {
      for (std::size_t tanks = 1; tanks <= most_tanks; ++tanks) nozzles.push_back({dead, mixing, tanks});
    }
  }
  return nozzles;
}

}  // namespace unicursal::test
