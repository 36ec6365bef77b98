#include <catch2/catch.hpp>

#include <vector>

#include "core/picture/filaments.hpp"

using namespace unicursal::picture;

namespace {

Colour mix(double blue, double red, double white, double black = 0) {
  return mixed_filaments(std::vector<double>{blue, red, white, 0, 0, black});
}

}  // namespace

TEST_CASE("a filament alone has its own colour") {
  for (std::size_t f = 0; f < filaments.size(); ++f) {
    std::vector<double> shares(filaments.size());
    shares[f] = 1;
    const Colour mixed = mixed_filaments(shares);
    CHECK(mixed.r == Approx(filaments[f].r).margin(1));
    CHECK(mixed.g == Approx(filaments[f].g).margin(1));
    CHECK(mixed.b == Approx(filaments[f].b).margin(1));
  }
}

TEST_CASE("dark covers light: a little black shows in white, a little white does not show in black") {
  const Colour white = mix(0, 0, 1), black = mix(0, 0, 0, 1);
  CHECK(white.g - mix(0, 0, 0.9, 0.1).g > 2 * (mix(0, 0, 0.1, 0.9).g - black.g));
  const Colour pink = mix(0, 0.5, 0.5);
  CHECK(pink.g < (filaments[1].g + white.g) / 2);
}

TEST_CASE("light makes brighter and darker, and ends at white") {
  CHECK(lit({100, 100, 100}, 0.5).r < 100);
  CHECK(lit({100, 100, 100}, 1) == Colour{100, 100, 100});
  CHECK(lit({200, 250, 10}, 9).g == 255);
}
