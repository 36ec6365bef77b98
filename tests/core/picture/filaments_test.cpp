#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "core/picture/colour_names.hpp"
#include "core/picture/filaments.hpp"
#include "core/picture/hex_colour.hpp"
#include "core/picture/nearest_shares.hpp"

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

TEST_CASE("greys mix by absorption over scattering, dark ones more strongly") {
  const Filaments own(std::vector<Colour>{{255, 255, 255}, {188, 188, 188}});
  CHECK(own.size() == usual_filaments.size());
  // By hand: 188 is 0.5029 of the light, lifted 0.5266, of which the ratio is 0.2128; white has none. Half of
  // it belongs to 0.6330, without the lift 0.6146, which is 206.
  CHECK(int(colour_of(std::vector<double>{0.5, 0.5}, own).r) == 206);
  CHECK(colour_of(std::vector<double>{0, 0, 1}, own) == usual_filaments[2]);  // beyond them the usual ones
}

TEST_CASE("a guessed reflectance has the colour that it was guessed from, in smooth steps") {
  const auto off = [](const Colour& colour) {
    const Reflectance reflected = reflectance_of(light_of(colour));
    for (const double band : reflected) CHECK((band > 0 && band < 1));
    return difference(lab_of(light_of(reflected)), lab_of(light_of(colour)));
  };
  for (const Colour colour : usual_filaments) CHECK(off(colour) < 0.1);
  for (const Colour colour : {Colour{255, 255, 255}, Colour{128, 128, 128}, Colour{20, 20, 20}})
    CHECK(off(colour) < 0.5);
  // Lamps have these; plastic hardly.
  for (const Colour colour : {Colour{255, 0, 0}, Colour{0, 255, 0}, Colour{0, 0, 255}, Colour{0, 0, 0}})
    CHECK(off(colour) < 4);
  // Blue plastic reflects short waves, yellow plastic long ones, and a grey reflects all alike.
  const Reflectance blue = reflectance_of(light_of(usual_filaments[0])),
                    yellow = reflectance_of(light_of(usual_filaments[3]));
  CHECK(blue[2] > 5 * blue[7]);
  CHECK(yellow[9] > 5 * yellow[1]);
  const Reflectance grey = reflectance_of({0.3, 0.3, 0.3});
  for (const double band : grey) CHECK(band == Approx(0.3).margin(0.001));
}

TEST_CASE("a light becomes the nearest byte") {
  for (int byte = 0; byte < 256; ++byte) {
    const double low = decoded(std::max(0.0, (byte - 0.499) / 255)),
                 high = decoded(std::min(1.0, (byte + 0.499) / 255));
    const auto expected = static_cast<std::uint8_t>(byte);
    CHECK(colour_of(Light{low, high, decoded(byte / 255.0)}) == Colour{expected, expected, expected});
  }
  CHECK(colour_of(Light{-1, 2, std::nan("")}) == Colour{0, 255, 0});
}

TEST_CASE("blue and yellow make green, and red and yellow orange") {
  const Filaments own(std::vector<Colour>{{245, 200, 30}, {30, 90, 190}, {245, 240, 230}, {200, 40, 40}});
  const Lab green = lab_of(mixed_light(std::vector<double>{0.7, 0.3, 0, 0}, own));
  CHECK(green.a < -10);
  CHECK(name_of(lab_of(light_of(Colour{50, 140, 75}))) == "green");
  CHECK(name_of(lab_of(mixed_light(std::vector<double>{0.7, 0, 0, 0.3}, own))).find("orange") !=
        std::string::npos);
}

TEST_CASE("differences of colours are those of the published pairs") {
  // Sharma, Wu and Dalal (2005), table 1: pairs 1, 4, 7, 10, 11, 13, 16, 17, 19, 25, 31 and 34.
  const struct {
    Lab one, other;
    double difference;
  } pairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
               {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
               {{50, 0, 0}, {50, -1, 2}, 2.3669},
               {{50, 2.49, -0.001}, {50, -2.49, 0.0010}, 7.1792},
               {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
               {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
               {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
               {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
               {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
               {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
               {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
               {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  for (const auto& [one, other, far] : pairs) {
    CHECK(difference(one, other) == Approx(far).margin(0.00005));
    CHECK(difference(other, one) == Approx(far).margin(0.00005));
  }
}

TEST_CASE("Lab and light are each other's inverse, and white is white") {
  for (const Colour colour : {Colour{0, 0, 0}, Colour{255, 255, 255}, Colour{200, 40, 7}, Colour{3, 90, 250}})
    CHECK(colour_of(light_of(lab_of(light_of(colour)))) == colour);
  const Lab white = lab_of(light_of(Colour{255, 255, 255}));
  CHECK(white.lightness == Approx(100));
  CHECK(std::abs(white.a) + std::abs(white.b) < 0.01);
  // ISO 12642: sRGB's red is about L 53.2, a 80.1, b 67.2 under D65.
  const Lab red = lab_of(light_of(Colour{255, 0, 0}));
  CHECK(red.lightness == Approx(53.24).margin(0.05));
  CHECK(red.a == Approx(80.09).margin(0.1));
  CHECK(red.b == Approx(67.20).margin(0.1));
}

TEST_CASE("the nearest shares are as near as any of a whole grid, keep the floor, and find what was mixed") {
  const std::size_t feeders = GENERATE(2, 3, 4);
  const Filaments own(std::vector<Colour>{{240, 190, 40}, {38, 96, 196}, {246, 240, 226}, {214, 52, 48}});
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 12; ++round) {
    const auto channel = [&] { return static_cast<std::uint8_t>(byte(random)); };
    const Colour wanted{channel(), channel(), channel()};
    const Lab lab = lab_of(light_of(wanted));
    const NearestShares found = nearest_shares(lab, own, feeders, 0.02);
    REQUIRE(found.shares.size() == feeders);
    double sum = 0;
    for (const double share : found.shares) {
      CHECK(share >= 0.02 - 1e-12);
      CHECK(share * 100 == Approx(std::round(share * 100)));
      sum += share;
    }
    CHECK(sum == Approx(1));
    CHECK(found.difference == Approx(difference(lab, lab_of(mixed_light(found.shares, own)))));
    // Every mixture in steps of 4 %, as a second opinion.
    std::vector<double> tried(feeders);
    double least = 1e9;
    const auto all = [&](auto&& self, std::size_t feeder, int left) -> void {
      if (feeder + 1 == feeders) {
        tried[feeder] = 0.02 + left * (1 - 0.02 * double(feeders)) / 25;
        least = std::min(least, difference(lab, lab_of(mixed_light(tried, own))));
        return;
      }
      for (int n = 0; n <= left; ++n) {
        tried[feeder] = 0.02 + n * (1 - 0.02 * double(feeders)) / 25;
        self(self, feeder + 1, left - n);
      }
    };
    all(all, 0, 25);
    CHECK(found.difference <= least + 0.25);  // whole per cent lie beside the grid
    const NearestShares again = nearest_shares(lab_of(found.made), own, feeders, 0.02);
    CHECK(again.difference < 0.2);
  }
  CHECK(nearest_shares(lab_of(light_of(Colour{240, 190, 40})), own, feeders, 0, 20).shares[0] == 1);
}

TEST_CASE("colours are read and written as people write them") {
  CHECK(colour_in("#e0604A") == Colour{224, 96, 74});
  CHECK(hex_of({224, 96, 74}) == "#e0604a");
  for (const char* wrong : {"", "e0604a", "#e0604", "#e0604a0", "#e0604g", "#-0604a", "#+1604a"})
    CHECK_FALSE(colour_in(wrong));
}
