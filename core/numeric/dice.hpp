// A fast stream of random numbers for inner loops, the same on every machine: a counter whose bits are mixed
// (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014). A stream costs nothing to
// begin, so that each piece of parallel work can have one of its own; random.hpp is for everything else.
#pragma once

#include <cstddef>
#include <cstdint>

namespace unicursal::core {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  /// In [0, 1), 53 random bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// In 0 … n − 1; precondition 0 < n < 2³².
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(((bits() >> 32) * n) >> 32); }

 private:
  std::uint64_t bits() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace unicursal::core
