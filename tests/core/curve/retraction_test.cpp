#include "core/curve/retraction.hpp"

#include <catch2/catch.hpp>

#include "core/curve/clearance.hpp"
#include "core/curve/resample.hpp"

namespace unicursal::core {
namespace {

/// A frame of beads 1 mm wide around a chamber 10 mm long and `room` wide, into which `fingers` fingers reach
/// from below.
struct Lobe {
  Curve curve;
  Polygon island;
};

Lobe lobe(int fingers, double room) {
  // Strands are `pitch` apart in the lobe; below it the curve runs back along a wide foot.
  const double pitch = room / (2 * fingers);
  Ring ring;
  for (int f = 0; f < fingers; ++f) {
    const double left = (2 * f + 0.5) * pitch, right = left + pitch;
    ring.insert(ring.end(),
                {Vec2(left, 1.5), Vec2(left, 12 - pitch / 2), Vec2(right, 12 - pitch / 2), Vec2(right, 1.5)});
  }
  ring.insert(ring.end(), {Vec2(room + 8, 1.5), Vec2(room + 8, 0.5), Vec2(-8, 0.5), Vec2(-8, 1.5)});
  Lobe result;
  result.island.outer = {{-9, 0},    {room + 9, 0}, {room + 9, 2}, {room, 2},
                         {room, 12}, {0, 12},       {0, 2},        {-9, 2}};
  const BorderIndex border(result.island, 1);
  result.curve = respaced({ring}, border, 0.5);
  return result;
}

/// The area of each strand: its length times half the distance to its neighbours on either side.
std::vector<double> areas_of(const Curve& curve, double room, int fingers) {
  std::vector<double> areas;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &a = curve.vertices[i], &b = curve.vertices[curve.after(i)];
    const bool inside = (a.y() + b.y()) / 2 > 2;
    areas.push_back((b - a).norm() * (inside ? room / (2 * fingers) : 1.0));
  }
  return areas;
}

double highest(const Curve& curve, double from, double to) {
  double result = 0;
  for (const Vec2& v : curve.vertices) {
    if (v.x() > from && v.x() < to) result = std::max(result, v.y());
  }
  return result;
}

TEST_CASE("One of two fingers is drawn back from a lobe that has room for one") {
  const double room = 2.3;
  const Lobe crowded = lobe(2, room);
  const BorderIndex border(crowded.island, 1);
  const Retraction result = retracted(crowded.curve, areas_of(crowded.curve, room, 2), border, 1);
  CHECK(result.fingers == 1);
  CHECK(self_intersections(result.curve) == 0);
  CHECK(segments_outside(result.curve, border) == 0);
  // About two strands of 10 mm are removed; the rest of the curve still reaches the end of the lobe.
  CHECK(crowded.curve.length() - result.curve.length() == Approx(18).margin(5));
  CHECK(highest(result.curve, 0, room) > 11);
}

TEST_CASE("Fingers that have enough room stay") {
  const Lobe roomy = lobe(2, 4);
  const BorderIndex border(roomy.island, 1);
  const Retraction result = retracted(roomy.curve, areas_of(roomy.curve, 4, 2), border, 1);
  CHECK(result.fingers == 0);
  CHECK(result.curve.vertices == roomy.curve.vertices);
}

TEST_CASE("The only finger of a narrow lobe stays, since no other strand would fill it") {
  const Lobe narrow = lobe(1, 1.4);
  const BorderIndex border(narrow.island, 1);
  const Retraction result = retracted(narrow.curve, areas_of(narrow.curve, 1.4, 1), border, 1);
  CHECK(highest(result.curve, 0, 1.4) > 8);
}

}  // namespace
}  // namespace unicursal::core
