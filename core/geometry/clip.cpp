#include "core/geometry/clip.hpp"

#include <utility>

namespace unicursal::core {
namespace {

bool keeps(Side side, const Vec2& p, double at) {
  switch (side) {
    case Side::left:
      return p.x() <= at;
    case Side::right:
      return p.x() >= at;
    case Side::below:
      return p.y() <= at;
    case Side::above:
      return p.y() >= at;
  }
  return false;
}

Vec2 crossing(Side side, const Vec2& a, const Vec2& b, double at) {
  if (side == Side::left || side == Side::right) {
    return {at, a.y() + (b.y() - a.y()) * (at - a.x()) / (b.x() - a.x())};
  }
  return {a.x() + (b.x() - a.x()) * (at - a.y()) / (b.y() - a.y()), at};
}

}  // namespace

Ring clipped(const Ring& ring, Side side, double at) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
    const bool a_in = keeps(side, a, at), b_in = keeps(side, b, at);
    if (a_in) kept.push_back(a);
    if (a_in != b_in) kept.push_back(crossing(side, a, b, at));
  }
  return kept;
}

std::vector<Ring> clipped(const std::vector<Ring>& rings, Side side, double at) {
  std::vector<Ring> result;
  for (const Ring& ring : rings) {
    Ring kept = clipped(ring, side, at);
    if (kept.size() >= 3) result.push_back(std::move(kept));
  }
  return result;
}

}  // namespace unicursal::core
