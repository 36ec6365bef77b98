#include "core/thin/thin_axis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/geometry/border_index.hpp"

namespace unicursal::core {
namespace {

// In bead widths.
constexpr double step = 0.25;        ///< between the nodes of the axis
constexpr double rounding = 0.02;    ///< by which a place may be narrower than the least width
constexpr double least_waist = 0.1;  ///< least radius anywhere
constexpr double least_reach =
    0.3;  ///< a branch that reaches less far out of the disc at its foot is left out
// As a share of that disc's radius: 0.41 in a right angle, 0.56 in one of 80°.
constexpr double corner_reach = 0.55;

void disconnect(MedialAxis& axis, std::size_t a, std::size_t b) {
  std::erase(axis[a].next, b);
  std::erase(axis[b].next, a);
}

/// From a dead end to the first node that is not passed through.
AxisChain branch_from(const ThinAxis& axis, std::size_t end) {
  AxisChain chain{end};
  for (std::size_t here = end, before = end;;) {
    const std::vector<std::size_t>& next = axis.nodes[here].next;
    if (next.empty()) return chain;
    const std::size_t ahead = next.size() > 1 && next[0] == before ? next[1] : next[0];
    before = here;
    here = ahead;
    chain.push_back(here);
    if (axis.degree(here) != 2 || axis.mouth[here]) return chain;
  }
}

/// How far the discs along a branch reach out of the disc at its foot.
double reach(const ThinAxis& axis, const AxisChain& branch) {
  const AxisNode& foot = axis.nodes[branch.back()];
  double farthest = 0;
  for (const std::size_t n : branch) {
    const AxisNode& node = axis.nodes[n];
    farthest = std::max(farthest, (node.position - foot.position).norm() + node.radius - foot.radius);
  }
  return farthest;
}

/// Removes branches into corners, round after round, since a foot may become part of another branch. All
/// branches of a round are judged before any of them is removed: the two corners of a wall's end share a
/// foot.
void prune(ThinAxis& axis, double w) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<std::pair<AxisChain, double>> corners;
    for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
      if (!axis.used[n] || axis.mouth[n] || axis.degree(n) != 1) continue;
      AxisChain branch = branch_from(axis, n);
      if (axis.degree(branch.back()) < 2 && !axis.mouth[branch.back()]) continue;
      const double out = reach(axis, branch);
      if (out < std::max(least_reach * w, corner_reach * axis.nodes[branch.back()].radius))
        corners.emplace_back(std::move(branch), out);
    }
    for (const auto& [branch, out] : corners) {
      for (std::size_t k = 0; k + 1 < branch.size(); ++k) {
        disconnect(axis.nodes, branch[k], branch[k + 1]);
        axis.used[branch[k]] = 0;
      }
      axis.corner[branch.back()] = std::max(axis.corner[branch.back()], out);
      changed = true;
    }
  }
}

}  // namespace

ThinAxis thin_axis(const Polygon& region, const Region& thin, double bead_width, double least_width) {
  const double w = bead_width;
  ThinAxis axis{medial_axis(region, step * w), {}, {}, {}};
  const std::size_t n = axis.nodes.size();
  std::vector<BorderIndex> pieces;
  for (const Polygon& piece : thin) pieces.emplace_back(piece, w);
  std::vector<char> inside(n);
  axis.used.assign(n, 0);
  axis.mouth.assign(n, 0);
  axis.corner.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    inside[k] = std::any_of(pieces.begin(), pieces.end(),
                            [&](const BorderIndex& piece) { return piece.contains(axis.nodes[k].position); });
    axis.used[k] = inside[k];
  }
  const std::vector<AxisNode> whole = axis.nodes;
  for (std::size_t k = 0; k < n; ++k) {
    for (const std::size_t other : whole[k].next) {
      if (inside[k] && !inside[other] && whole[other].radius > whole[k].radius - rounding * w)
        axis.mouth[k] = 1;
      if (!inside[k] || !inside[other]) disconnect(axis.nodes, k, other);
    }
  }
  prune(axis, w);
  // Dead ends are shortened to where a bead fits. A waist that is a little too narrow keeps its strand, so
  // that the curve passes.
  for (std::size_t k = 0; k < n; ++k) {
    if (axis.nodes[k].radius >= least_waist * w) continue;
    const std::vector<std::size_t> neighbours = axis.nodes[k].next;
    for (const std::size_t other : neighbours) disconnect(axis.nodes, k, other);
    axis.used[k] = axis.mouth[k] = 0;
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t end = k; axis.used[end] && !axis.mouth[end] && axis.degree(end) <= 1 &&
                              2 * axis.nodes[end].radius < least_width - rounding * w;) {
      axis.used[end] = 0;
      if (axis.nodes[end].next.empty()) break;
      const std::size_t next = axis.nodes[end].next.front();
      disconnect(axis.nodes, end, next);
      end = next;
    }
  }
  return axis;
}

std::vector<AxisChain> chains(const ThinAxis& axis, const std::vector<char>& breaks) {
  std::vector<AxisChain> result;
  std::set<std::pair<std::size_t, std::size_t>> done;
  const auto follow = [&](std::size_t first, std::size_t second) {
    AxisChain chain{first, second};
    done.insert({first, second});
    done.insert({second, first});
    while (chain.back() != first && !breaks[chain.back()] && axis.degree(chain.back()) == 2) {
      const std::size_t here = chain.back(), before = chain[chain.size() - 2];
      const std::vector<std::size_t>& next = axis.nodes[here].next;
      const std::size_t ahead = next[0] == before ? next[1] : next[0];
      done.insert({here, ahead});
      done.insert({ahead, here});
      chain.push_back(ahead);
    }
    result.push_back(std::move(chain));
  };
  // Rings without any such node begin at their first node, after all others.
  for (const bool rings : {false, true}) {
    for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
      if (!rings && axis.degree(n) == 2 && !breaks[n]) continue;
      for (const std::size_t next : axis.nodes[n].next) {
        if (done.count({n, next}) == 0) follow(n, next);
      }
    }
  }
  return result;
}

std::vector<AxisChain> faces(const ThinAxis& axis) {
  const auto angle = [&](std::size_t from, std::size_t to) {
    const Vec2 d = axis.nodes[to].position - axis.nodes[from].position;
    return std::atan2(d.y(), d.x());
  };
  std::vector<std::vector<std::size_t>> around(axis.nodes.size());
  for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
    around[n] = axis.nodes[n].next;
    std::sort(around[n].begin(), around[n].end(),
              [&](std::size_t l, std::size_t r) { return angle(n, l) < angle(n, r); });
  }
  using Half = std::pair<std::size_t, std::size_t>;
  std::map<Half, std::size_t> face_of;
  std::vector<std::vector<Half>> walks;
  for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
    for (const std::size_t next : around[n]) {
      if (face_of.count({n, next}) != 0) continue;
      std::vector<Half> walk;
      for (Half half{n, next}; face_of.emplace(half, walks.size()).second;) {
        walk.push_back(half);
        // The next edge clockwise from the one that leads back has the face on its left.
        const std::vector<std::size_t>& all = around[half.second];
        const auto back = std::find(all.begin(), all.end(), half.first);
        const std::size_t ahead = back == all.begin() ? all.back() : *(back - 1);
        half = {half.second, ahead};
      }
      walks.push_back(std::move(walk));
    }
  }
  std::vector<AxisChain> result;
  for (std::size_t f = 0; f < walks.size(); ++f) {
    AxisChain ring;
    std::size_t last = 0;
    bool one_ring = true;
    for (const Half& half : walks[f]) {
      if (face_of.at({half.second, half.first}) == f) continue;
      one_ring = one_ring && (ring.empty() || last == half.first);
      ring.push_back(half.first);
      last = half.second;
    }
    if (ring.size() < 3 || !one_ring || last != ring.front()) continue;
    if (std::set<std::size_t>(ring.begin(), ring.end()).size() != ring.size()) continue;
    Ring line;
    for (const std::size_t n : ring) line.push_back(axis.nodes[n].position);
    if (signed_area(line) > 0) result.push_back(std::move(ring));
  }
  return result;
}

}  // namespace unicursal::core
