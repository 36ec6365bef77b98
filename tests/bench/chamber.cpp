// Compares the simulated nozzle with tanks in series. One feeder replaces another in a step; the share of the
// new feeder in each bead is compared with the gamma distribution, integrated by Simpson's rule. Prints the
// greatest difference for one to five tanks and for feeds of several lengths.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/nozzle/chamber.hpp"

using namespace unicursal::sim;

namespace {

/// Step response of equal tanks in series after `x` volumes of one tank have passed.
double analytic(double x, unsigned tanks) {
  constexpr int steps = 2000;
  double integral = 0;
  for (int i = 0; i <= steps; ++i) {
    const double u = x * i / steps;
    const double density = std::pow(u, tanks - 1) * std::exp(-u) / std::tgamma(tanks);
    integral += density * (i == 0 || i == steps ? 1 : i % 2 == 0 ? 2 : 4);
  }
  return integral * x / steps / 3;
}

double greatest_difference(const ChamberSize& size, double portion) {
  constexpr double long_enough = 20;  // mm³ after the step
  Chamber chamber(size, 3);
  chamber.feed({1000, 0, 0});
  double passed = 0, worst = 0;
  while (passed < long_enough) {
    for (const Outflow& flow : chamber.feed({0, portion, 0})) {
      const double middle = passed + flow.total() / 2;
      passed += flow.total();
      const double x = std::max(0.0, middle - size.dead_volume) / tank_volume(size);
      const double expected = analytic(x, static_cast<unsigned>(size.tanks));
      worst = std::max(worst, std::abs(flow.volume[1] / flow.total() - expected));
    }
  }
  return worst;
}

}  // namespace

int main() {
  for (const std::size_t tanks : {1, 2, 3, 5}) {
    ChamberSize size;
    size.tanks = tanks;
    fmt::print("{} tanks behind {} mm³: off by at most", tanks, size.dead_volume);
    for (const double portion : {0.003, 0.05, 0.7}) {
      fmt::print(" {:.2f} % (portions of {} mm³)", 100 * greatest_difference(size, portion), portion);
    }
    fmt::print("\n");
  }
}
