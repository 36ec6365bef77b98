#include "core/drawing/svg_path.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "core/text/malformed.hpp"

using namespace unicursal::core;

namespace {

std::vector<Ring> rings(std::string_view text, const Eigen::Affine2d& map = Eigen::Affine2d::Identity()) {
  Outline outline(map);
  if (const auto mistake = draw_path(text, outline)) throw Malformed(*mistake);
  return outline.rings();
}

double enclosed_area(std::string_view text) {
  double sum = 0;
  for (const Ring& ring : rings(text)) sum += signed_area(ring);
  return sum;
}

/// An inscribed outline is smaller by at most two thirds of the flattening along its length.
void check_area(std::string_view text, double expected, double length) {
  CAPTURE(text);
  CHECK(std::abs(enclosed_area(text) - expected) <= flattening * length);
}

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("straight commands, absolute and relative, draw the same square") {
  const auto text = GENERATE("M1 2L5 2L5 6L1 6Z", "M1,2 5,2 5,6 1,6z", "m1 2l4 0l0 4l-4 0z",
                             "m1,2 4,0 0,4 -4,0", "M1 2H5V6H1Z", "m1 2h4v4h-4z", "M1 2 5 2V6H1",
                             "M1-.2e1M1 2h+4v4H1", " \n M 1 2\tH 5 V 6 H 1 z ");
  CAPTURE(text);
  REQUIRE(rings(text).size() == 1);
  CHECK(enclosed_area(text) == Approx(16));
  CHECK(bounds(rings(text).front()).min == Vec2(1, 2));
}

TEST_CASE("numbers may run together") {
  CHECK(enclosed_area("M0 0L1.5.5-1 2Z") == Approx(0.5 * (1.5 * 2 + 1 * 0.5)));
}

TEST_CASE("after closing, relative commands start where the ring started") {
  const auto both = rings("m1 1h2v2h-2z m10 0h2v2h-2z");
  REQUIRE(both.size() == 2);
  CHECK(bounds(both[1]).min == Vec2(11, 1));
  const auto without_move = rings("M1 1h2v2h-2z h-3v-3z");
  REQUIRE(without_move.size() == 2);
  CHECK(bounds(without_move[1]).min == Vec2(-2, -2));
}

TEST_CASE("Bézier curves enclose their closed-form areas") {
  check_area("M0 0Q10 20 20 0Z", -20.0 * 10 * 2 / 3, 50);  // a parabola of height 10
  check_area("M0 0q10 20 20 0z", -20.0 * 10 * 2 / 3, 50);
  check_area("M0 0C0 10 20 10 20 0Z", -20.0 * 10 * 3 / 5, 50);  // ∫ y dx of this cubic is 3/5 · w · h
  check_area("M0 0c0 10 20 10 20 0z", -20.0 * 10 * 3 / 5, 50);
}

TEST_CASE("S and T mirror the last control point, and only of their own kind") {
  check_area("M0 0Q5 10 10 0T20 0Z", 0, 50);  // one arch up, one down
  check_area("M0 0q5 10 10 0t10 0z", 0, 50);
  check_area("M0 0C0 5 10 5 10 0S20 -5 20 0Z", 0, 50);
  check_area("M0 0c0 5 10 5 10 0s10 -5 10 0z", 0, 50);
  CHECK(enclosed_area("M0 0C0 5 10 5 10 0T20 0V-5H0Z") ==
        Approx(enclosed_area("M0 0C0 5 10 5 10 0L20 0V-5H0Z")));
  // After Q the first control point of S is the pen.
  CHECK(enclosed_area("M0 0Q5 9 10 0S20 9 20 0Z") == Approx(enclosed_area("M0 0Q5 9 10 0C10 0 20 9 20 0Z")));
}

TEST_CASE("arcs enclose their closed-form areas") {
  check_area("M10 0A10 10 0 0 1-10 0Z", 50 * pi, 60);
  check_area("M10 0a10 10 0 01-20 0z", 50 * pi, 60);        // flags without separators
  check_area("M10 0A10 10 0 0 0-10 0Z", -50 * pi, 60);      // the other way round
  check_area("M10 0A10 10 0 0 1 0 10L0 0Z", 25 * pi, 60);   // a quarter
  check_area("M10 0A10 10 0 1 0 0 10L0 0Z", -75 * pi, 80);  // the other three
  check_area("M20 0A20 5 0 0 1-20 0A20 5 0 0 1 20 0Z", 100 * pi, 90);
  check_area("M0 20A20 5 90 0 1 0-20A20 5 90 0 1 0 20Z", 100 * pi, 90);
  check_area("M10 0A1 1 0 0 1-10 0Z", 50 * pi, 60);       // too small radii grow
  check_area("M10 0A-10 -10 0 0 1-10 0Z", 50 * pi, 60);   // their sign does not count
  check_area("M10 0A0 5 0 0 1 0 10L0 0Z", 50, 60);        // no radius: a line
  check_area("M0 0H10A1e9 1e9 0 0 1 10 10H0Z", 100, 60);  // nearly straight
}

TEST_CASE("flattening keeps to its tolerance through a transform") {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  map.scale(Vec2(40, 0.5));
  for (const Ring& ring : rings("M1 0A1 1 0 0 1-1 0A1 1 0 0 1 1 0Z", map)) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = map.inverse() * ring[i], b = map.inverse() * ring[(i + 1) % ring.size()];
      CHECK(std::abs(a.norm() - 1) < 1e-9);
      // The middle of the arc between a and b, and its distance from the chord.
      const Vec2 middle = map * Vec2((a + b).normalized());
      CHECK(distance_to_segment(middle, ring[i], ring[(i + 1) % ring.size()]) <= flattening);
    }
  }
}

TEST_CASE("damage in path data is reported") {
  const auto text =
      GENERATE("L1 1", "M", "M1", "M1 1L", "M1 1L2", "M0 0X", "M0 0 1 1 2", "M0 0A1 1 0 2 0 1 1",
               "M0 0A1 1 0 1 1", "M0 0Lnan 1", "M0 0L1e999 1", "M0 0L1e300 0L0 1e300Z", "M0 0L1,,2",
               "M0 0Z5 5", "M0 0C1 1 2 2", "5 5", "M inf 0");
  CAPTURE(text);
  CHECK_THROWS_AS(rings(text), Malformed);
}

TEST_CASE("a damaged path is drawn up to its mistake") {
  Outline outline(Eigen::Affine2d::Identity());
  const auto mistake = draw_path("M0 0H4V4H0Z M9 9 L1", outline);
  REQUIRE(mistake.has_value());
  REQUIRE(outline.rings().size() == 1);
  CHECK(signed_area(outline.rings().front()) == Approx(16));
}

TEST_CASE("an empty text is not a ring") {
  CHECK(rings("").empty());
  CHECK(rings("none").empty());
  CHECK(rings("M5 5").empty());
  CHECK(rings("M5 5L6 6").empty());
}

TEST_CASE("random text is drawn or refused, and every point drawn is finite") {
  std::mt19937 random(20240607);
  const std::string alphabet = "MmLlHhVvCcSsQqTtAaZz0123456789.-+eE, \n\t#";
  std::size_t drawn = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = round % 2 ? "M0 0" : "";
    const std::size_t length = random() % 40;
    while (text.size() < length) text += alphabet[random() % alphabet.size()];
    try {
      for (const Ring& ring : rings(text)) {
        for (const Vec2& p : ring) REQUIRE(p.allFinite());
      }
      ++drawn;
    } catch (const Malformed&) {
    }
  }
  CHECK(drawn > 100);
}

TEST_CASE("random sound commands never fail") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-50, 50), radius(20, 50);
  const std::string commands = "MLHVCSQTAZmlhvcsqtaz", arguments = "2211644270";
  const auto argument = [&](bool arc, int k) {
    if (arc && (k == 3 || k == 4)) return std::to_string(random() % 2);
    return std::to_string(arc && k < 2 ? radius(random) : number(random));
  };
  for (int round = 0; round < 2000; ++round) {
    std::string text = "M0 0";
    for (int i = 0; i < 8; ++i) {
      const std::size_t kind = random() % commands.size();
      const int count = arguments[kind % 10] - '0';
      text += commands[kind];
      for (int k = 0; k < count; ++k) text += ' ' + argument(count == 7, k);
    }
    CAPTURE(text);
    CHECK_NOTHROW(rings(text));
  }
}
