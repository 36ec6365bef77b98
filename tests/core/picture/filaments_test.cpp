#include <catch2/catch.hpp>

#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/hex_colour.hpp"

using namespace unicursal::picture;

namespace {

Colour mix(double blue, double red, double white, double black = 0) {
  return colour_of(std::vector<double>{blue, red, white, 0, 0, black}, Filaments());
}

}  // namespace

TEST_CASE("a filament alone has its own colour") {
  for (std::size_t f = 0; f < usual_filaments.size(); ++f) {
    std::vector<double> shares(usual_filaments.size());
    shares[f] = 1;
    const Colour mixed = colour_of(shares, Filaments());
    CHECK(mixed.r == Approx(usual_filaments[f].r).margin(1));
    CHECK(mixed.g == Approx(usual_filaments[f].g).margin(1));
    CHECK(mixed.b == Approx(usual_filaments[f].b).margin(1));
  }
}

TEST_CASE("dark covers light: a little black shows in white, a little white does not show in black") {
  const Colour white = mix(0, 0, 1), black = mix(0, 0, 0, 1);
  CHECK(white.g - mix(0, 0, 0.9, 0.1).g > 2 * (mix(0, 0, 0.1, 0.9).g - black.g));
  const Colour pink = mix(0, 0.5, 0.5);
  CHECK(pink.g < (usual_filaments[1].g + white.g) / 2);
}

TEST_CASE("light makes brighter and darker, and ends at white") {
  CHECK(lit({100, 100, 100}, 0.5).r < 100);
  CHECK(lit({100, 100, 100}, 1) == Colour{100, 100, 100});
  CHECK(lit({200, 250, 10}, 9).g == 255);
}

TEST_CASE("own filaments mix to the geometric mean of their light, and the others are the usual ones") {
  const Filaments own(std::vector<Colour>{{255, 255, 255}, {188, 0, 128}});
  CHECK(own.size() == usual_filaments.size());
  // 188 reflects half of the light: half of it mixed with white is √½, which is 218.
  CHECK(colour_of(std::vector<double>{0.5, 0.5}, own).r == Approx(218).margin(1));
  CHECK(colour_of(std::vector<double>{0, 0, 1}, own) == usual_filaments[2]);
}

TEST_CASE("colours are read and written as people write them") {
  CHECK(colour_in("#e0604A") == Colour{224, 96, 74});
  CHECK(hex_of({224, 96, 74}) == "#e0604a");
  for (const char* wrong : {"", "e0604a", "#e0604", "#e0604a0", "#e0604g", "#-0604a", "#+1604a"})
    CHECK_FALSE(colour_in(wrong));
}
