// Random numbers that are the same on every machine. The standard fixes the engine but not the distributions
// of <random>, so the few distributions that are needed are written out.
#pragma once

#include <cstdint>
#include <random>

namespace unicursal::core {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), 53 random bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In 0 … n − 1; precondition n > 0.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace unicursal::core
