#include "core/curve/join.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/curve/joints.hpp"

namespace unicursal::core {
namespace {

/// One end of a joint's opening.
struct End {
  std::size_t track = 0;
  double position = 0;
  bool forwards = false;    ///< the remaining curve runs forwards from here
  std::size_t mate = 0;     ///< the end to which the bridge from here leads
  std::size_t far_end = 0;  ///< the end at which the remaining curve from here meets the next opening
};

/// Four ends for each joint, in the order from, to, from, to of its openings.
std::vector<End> ends_of(const std::vector<Joint>& joints) {
  std::vector<End> ends;
  for (const Joint& joint : joints) {
    const std::size_t first = ends.size();
    for (const Opening& opening : joint.openings) {
      ends.push_back({opening.track, opening.from, false});
      ends.push_back({opening.track, opening.to, true});
    }
    const std::size_t of_from = joint.crosswise ? first + 3 : first + 2;
    const std::size_t of_to = joint.crosswise ? first + 2 : first + 3;
    ends[first].mate = of_from, ends[of_from].mate = first;
    ends[first + 1].mate = of_to, ends[of_to].mate = first + 1;
  }
  return ends;
}

/// Finds the stretches that remain: from the far end of each opening to the next opening along the curve.
void pair_far_ends(std::vector<End>& ends) {
  std::vector<std::size_t> order(ends.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) {
    return std::pair(ends[l].track, ends[l].position) < std::pair(ends[r].track, ends[r].position);
  });
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && ends[order[last]].track == ends[order[first]].track) ++last;
    const std::size_t count = last - first;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t here = order[first + k], next = order[first + (k + 1) % count];
      if (!ends[here].forwards) continue;
      assert(!ends[next].forwards);
      ends[here].far_end = next;
      ends[next].far_end = here;
    }
    first = last;
  }
}

Curve walked(const std::vector<Track>& tracks, const std::vector<End>& ends) {
  Curve curve;
  std::size_t here = 0;
  do {
    const End &from = ends[here], &to = ends[from.far_end];
    const Track& track = tracks[from.track];
    std::vector<Vec2> points =
        from.forwards ? track.stretch(from.position, to.position) : track.stretch(to.position, from.position);
    if (!from.forwards) std::reverse(points.begin(), points.end());
    curve.vertices.insert(curve.vertices.end(), points.begin(), points.end());
    here = to.mate;
  } while (here != 0);
  return curve;
}

}  // namespace

std::optional<Curve> joined(std::vector<Curve> curves, const Polygon& island, double bead_width,
                            const JointPrice& price) {
  if (curves.empty()) return std::nullopt;
  if (curves.size() == 1) return std::move(curves.front());
  std::vector<Track> tracks;
  for (Curve& curve : curves) tracks.emplace_back(std::move(curve));
  const std::vector<Joint> joints = find_joints(tracks, island, bead_width, price);
  if (joints.size() + 1 != tracks.size()) return std::nullopt;
  std::vector<End> ends = ends_of(joints);
  pair_far_ends(ends);
  return walked(tracks, ends);
}

}  // namespace unicursal::core
