#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "sim/nozzle/chamber.hpp"

using namespace unicursal::sim;

namespace {

PerFeeder<double> operator*(PerFeeder<double> shares, double volume) {
  for (double& share : shares) share *= volume;
  return shares;
}

double total(const PerFeeder<double>& volume) {
  return std::accumulate(volume.begin(), volume.end(), 0.0);
}

constexpr PerFeeder<double> red{1, 0, 0}, blue{0, 1, 0}, third{0.2, 0.3, 0.5};

}  // namespace

TEST_CASE("the step response is that of a pipe and tanks in series") {
  ChamberSize size;
  size.tanks = GENERATE(1u, 2u, 3u, 5u);
  Chamber chamber(size, 3);
  chamber.feed(red * 1000);
  const double portion = GENERATE(0.003, 0.05, 0.7);
  const double tank = tank_volume(size);
  double passed = 0;
  while (passed < 20) {
    for (const Outflow& flow : chamber.feed(blue * portion)) {
      const double middle = passed + flow.total() / 2;
      passed += flow.total();
      // An independent computation: the integral of the gamma density, by Simpson's rule.
      const double x = std::max(0.0, middle - size.dead_volume) / tank;
      double integral = 0;
      const int steps = 400;
      for (int i = 0; i <= steps; ++i) {
        const double u = x * i / steps;
        const double density = std::pow(u, size.tanks - 1) * std::exp(-u) / std::tgamma(size.tanks);
        integral += density * (i == 0 || i == steps ? 1 : i % 2 == 0 ? 2 : 4);
      }
      integral *= x / steps / 3;
      CHECK(flow.volume[1] / flow.total() == Approx(integral).margin(0.01));
    }
  }
}

TEST_CASE("the new mixture arrives after the dead volume, and 95 % of it after the mixing volume") {
  const ChamberSize size{2.1, 4.0, GENERATE(1u, 2u, 4u)};
  CHECK(step_response(size, 2.099) == 0);
  CHECK(step_response(size, 2.3) > 0);
  CHECK(step_response(size, 6.1) == Approx(0.95));
}

TEST_CASE("a chamber without any volume mixes at once") {
  Chamber chamber({0, 0, 2}, 3);
  chamber.feed(red * 5);
  const auto flows = chamber.feed(third * 2);
  REQUIRE(flows.size() == 1);
  CHECK(flows[0].volume[2] == Approx(1));
  CHECK(total(chamber.content()) == Approx(0).margin(1e-12));
}

TEST_CASE("every feeder's volume is kept, whatever is fed and retracted") {
  const ChamberSize size = GENERATE(ChamberSize{}, ChamberSize{0, 4, 1}, ChamberSize{2, 0, 2},
                                    ChamberSize{0, 0, 2}, ChamberSize{0.3, 9, 6});
  Chamber chamber(size, 3);
  const PerFeeder<double> before = chamber.content();
  PerFeeder<double> fed{}, out{};
  std::mt19937 random(17);
  std::uniform_real_distribution<double> volume(-0.02, 0.1);
  std::discrete_distribution<int> rarely{99, 1};
  for (int i = 0; i < 20000; ++i) {
    PerFeeder<double> portion{volume(random), volume(random), volume(random)};
    if (rarely(random) == 1) portion = portion * 60;
    for (std::size_t f = 0; f < 3; ++f) fed[f] += portion[f];
    for (const Outflow& flow : chamber.feed(portion)) {
      for (std::size_t f = 0; f < 3; ++f) {
        CHECK(flow.volume[f] >= 0);
        out[f] += flow.volume[f];
      }
    }
  }
  const PerFeeder<double> after = chamber.content();
  for (std::size_t f = 0; f < 3; ++f) {
    CHECK(out[f] + after[f] - before[f] == Approx(fed[f]).epsilon(1e-9));
  }
}

TEST_CASE("the response is linear in the mixture") {
  Chamber first({}, 3), second({}, 3), both({}, 3);
  const double part = 0.3;  // share of the first sequence of mixtures in the third
  std::mt19937 random(2);
  std::uniform_real_distribution<double> volume(0, 0.3), share(0, 1);
  const auto output = [](Chamber& chamber, const PerFeeder<double>& fed) {
    PerFeeder<double> sum{};
    for (const Outflow& flow : chamber.feed(fed)) {
      for (std::size_t f = 0; f < 3; ++f) sum[f] += flow.volume[f];
    }
    return sum;
  };
  for (int i = 0; i < 300; ++i) {
    const double v = volume(random), s = share(random), t = share(random);
    const PerFeeder<double> a{s * v, (1 - s) * v}, b{0, t * v, (1 - t) * v};
    PerFeeder<double> c{};
    for (std::size_t f = 0; f < 3; ++f) c[f] = part * a[f] + (1 - part) * b[f];
    const auto out_a = output(first, a), out_b = output(second, b), out_c = output(both, c);
    for (std::size_t f = 0; f < 3; ++f) {
      CHECK(out_c[f] == Approx(part * out_a[f] + (1 - part) * out_b[f]).margin(1e-12));
    }
  }
}

TEST_CASE("it does not matter how a feed is cut into pieces") {
  Chamber whole({}, 3), pieces({}, 3);
  PerFeeder<double> a{}, b{};
  for (const auto& shares : {red, third, blue, red}) {
    for (const Outflow& flow : whole.feed(shares * 1.7)) {
      for (std::size_t f = 0; f < 3; ++f) a[f] += flow.volume[f];
    }
    for (int i = 0; i < 17; ++i) {
      for (const Outflow& flow : pieces.feed(shares * 0.1)) {
        for (std::size_t f = 0; f < 3; ++f) b[f] += flow.volume[f];
      }
    }
    for (std::size_t f = 0; f < 3; ++f) CHECK(a[f] == Approx(b[f]).margin(1e-12));
  }
}

TEST_CASE("retracted filament must be fed again before anything comes out") {
  Chamber chamber({}, 3);
  CHECK(chamber.feed({-1, -1, -1}).empty());
  CHECK(chamber.feed({0.5, 0.5, 0.5}).empty());
  const auto flows = chamber.feed({1, 0.5, 0});
  REQUIRE(flows.size() == 1);
  CHECK(flows[0].from == Approx(0.5));
  CHECK(flows[0].to == 1);
  CHECK(flows[0].total() == Approx(0.5));
}
