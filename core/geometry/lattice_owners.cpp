#include "core/geometry/lattice_owners.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/geometry/nearest_kernel.hpp"
#include "core/geometry/segment_rows.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t range = 4096;  ///< segments in one piece of work when sums are gathered

}  // namespace

LatticeOwners::LatticeOwners(const Lattice& lattice, const OwnerOptions& options)
    : lattice_(lattice),
      slack_(options.slack),
      split_(options.split),
      workers_(options.workers != nullptr ? *options.workers : serial_) {}

void LatticeOwners::assign(std::vector<Segment> segments) {
  const bool lists_good = lists_hold(segments);
  current_ = std::move(segments);
  owner_.resize(lattice_.size());
  if (!lists_good) make_lists();
  workers_.each(lattice_.tiles.size(), [this](std::size_t tile) { scan(tile); });
  second_moment_ = 0;
  for (const double moment : tile_moments_) second_moment_ += moment;
  pulls_.assign(current_.size(), {});
  gather([this](std::size_t segment, std::size_t sum) {
    const std::array<float, 4>& s = tile_sums_[sum];
    pulls_[segment].all += Vec2(s[0], s[1]);
    pulls_[segment].end += Vec2(s[2], s[3]);
  });
}

bool LatticeOwners::lists_hold(const std::vector<Segment>& segments) const {
  if (lists_.empty() || listed_.size() != segments.size()) return false;
  const double most = slack_ * slack_;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!((segments[i].a - listed_[i].a).squaredNorm() <= most)) return false;
    if (!((segments[i].b - listed_[i].b).squaredNorm() <= most)) return false;
  }
  return true;
}

void LatticeOwners::make_lists() {
  listed_ = current_;
  lists_.resize(lattice_.tiles.size());
  tile_moments_.assign(lattice_.tiles.size(), 0);
  if (listed_.empty()) {
    for (std::size_t t = 0; t < lists_.size(); ++t) {
      const Lattice::Tile& tile = lattice_.tiles[t];
      lists_[t].start.assign(lattice_.last_block(tile) - lattice_.first_block(tile) + 1, 0);
    }
  } else {
    const SegmentRows rows(listed_);
    workers_.each(lists_.size(), [&](std::size_t tile) {
      // The second owner of a split square is at most one diagonal of a square farther than the nearest.
      const double farther = split_ ? std::numbers::sqrt2 * lattice_.pitch : 0;
      make_near_lists(lattice_, lattice_.tiles[tile], listed_, rows, slack_ + farther / 2, lists_[tile]);
    });
  }
  number_sums();
}

/// Every tile has its own sum for each of its segments; the sums of one segment are listed in order of tiles.
void LatticeOwners::number_sums() {
  first_sum_.assign(1, 0);
  for (const NearLists& lists : lists_) first_sum_.push_back(first_sum_.back() + lists.segments.size());
  tile_sums_.resize(first_sum_.back());
  sum_start_.assign(listed_.size() + 1, 0);
  for (const NearLists& lists : lists_) {
    for (const std::int32_t segment : lists.segments) ++sum_start_[static_cast<std::size_t>(segment) + 1];
  }
  for (std::size_t s = 1; s < sum_start_.size(); ++s) sum_start_[s] += sum_start_[s - 1];
  sum_of_.resize(first_sum_.back());
  std::vector<std::uint32_t> next(sum_start_.begin(), sum_start_.end() - 1);
  std::uint32_t sum = 0;
  for (const NearLists& lists : lists_) {
    for (const std::int32_t segment : lists.segments)
      sum_of_[next[static_cast<std::size_t>(segment)]++] = sum++;
  }
}

void LatticeOwners::scan(std::size_t number) {
  const Lattice::Tile& tile = lattice_.tiles[number];
  const NearLists& lists = lists_[number];
  std::vector<TileSegment> segments;
  segments.reserve(lists.segments.size());
  for (const std::int32_t s : lists.segments) {
    segments.push_back(in_tile(current_[static_cast<std::size_t>(s)], tile.corner));
  }
  std::array<float, 4>* sums = tile_sums_.data() + first_sum_[number];
  std::fill_n(sums, segments.size(), std::array<float, 4>{});
  const std::size_t first = lattice_.first_block(tile);
  tile_moments_[number] =
      scan_blocks({lattice_.blocks.data() + first, lattice_.last_block(tile) - first, lattice_.borders.data(),
                   static_cast<float>(lattice_.pitch), segments.data(), lists.start.data(),
                   lists.entries.data(), owner_.data() + Lattice::lanes * first, sums,
                   split_ ? lists.segments.data() : nullptr, static_cast<std::int32_t>(current_.size())});
}

/// Calls add(segment, sum index) for all sums of all segments, in order for each segment.
template <typename Add>
void LatticeOwners::gather(Add add) const {
  workers_.ranges(current_.size(), range, [&](std::size_t first, std::size_t last) {
    for (std::size_t segment = first; segment < last; ++segment) {
      for (std::uint32_t k = sum_start_[segment]; k < sum_start_[segment + 1]; ++k) add(segment, sum_of_[k]);
    }
  });
}

std::int32_t LatticeOwners::owner(std::size_t sample) const {
  const std::int32_t local = owner_[sample];
  if (local < 0) return -1;
  const auto tile = static_cast<std::size_t>(lattice_.blocks[sample / Lattice::lanes].tile);
  return lists_[tile].segments[static_cast<std::size_t>(local)];
}

double LatticeOwners::distance2(std::size_t sample) const {
  const Segment& nearest = current_[static_cast<std::size_t>(owner(sample))];
  const double distance = distance_to_segment(lattice_.position(sample), nearest.a, nearest.b);
  return distance * distance;
}

std::vector<Vec2> LatticeOwners::sums(const std::vector<std::array<float, 2>>& values) const {
  std::vector<std::array<float, 2>> parts(tile_sums_.size(), {0, 0});
  workers_.each(lattice_.tiles.size(), [&](std::size_t number) {
    const Lattice::Tile& tile = lattice_.tiles[number];
    const std::size_t last = Lattice::lanes * lattice_.last_block(tile);
    for (std::size_t k = Lattice::lanes * lattice_.first_block(tile); k < last; ++k) {
      if (owner_[k] < 0) continue;
      std::array<float, 2>& part = parts[first_sum_[number] + static_cast<std::size_t>(owner_[k])];
      part[0] += values[k][0];
      part[1] += values[k][1];
    }
  });
  std::vector<Vec2> result(current_.size(), Vec2(0, 0));
  gather(
      [&](std::size_t segment, std::size_t sum) { result[segment] += Vec2(parts[sum][0], parts[sum][1]); });
  return result;
}

}  // namespace unicursal::core
