#include "core/geometry/near_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace unicursal::core {
namespace {

constexpr float rounding = 1e-5F;  ///< relative; added to the limit that decides which segments are listed
constexpr double first_reach = 9;  ///< lattice squares; how far the first search reaches
constexpr double headroom = 1.1;   ///< on the reach of the next search, if the first was too short
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Segments as one array per number, for vector code.
struct SegmentArrays {
  std::vector<float> ax, ay, ux, uy, inverse;

  void clear() {
    for (auto* array : {&ax, &ay, &ux, &uy, &inverse}) array->clear();
  }
  void add(const TileSegment& s) {
    ax.push_back(s.ax);
    ay.push_back(s.ay);
    ux.push_back(s.ux);
    uy.push_back(s.uy);
    inverse.push_back(s.inverse);
  }
  /// Adds segments far from everything, so that vector code may read past the end.
  void pad() {
    for (std::size_t k = 0; k < Lattice::lanes; ++k) add({1e18F, 1e18F, 0, 0, 0});
  }
};

/// Encloses the samples of a block, relative to the corner of the tile.
struct Circle {
  float x, y, radius;
};

Circle circle_around(const Lattice& lattice, const Lattice::Block& block) {
  const auto pitch = static_cast<float>(lattice.pitch);
  if (block.border < 0) {
    return {block.x + 2 * pitch, block.y + pitch, std::sqrt(2.5F) * pitch};
  }
  const Lattice::BorderBlock& border = lattice.borders[static_cast<std::size_t>(block.border)];
  float low_x = infinite, low_y = infinite, high_x = -infinite, high_y = -infinite;
  for (std::size_t k = 0; k < Lattice::lanes; ++k) {
    if (!(border.weight[k] > 0)) continue;
    low_x = std::min(low_x, border.x[k]);
    high_x = std::max(high_x, border.x[k]);
    low_y = std::min(low_y, border.y[k]);
    high_y = std::max(high_y, border.y[k]);
  }
  return {(low_x + high_x) / 2, (low_y + high_y) / 2, std::hypot(high_x - low_x, high_y - low_y) / 2};
}

class ListMaker {
 public:
  ListMaker(const Lattice& lattice, const Lattice::Tile& tile, const std::vector<Segment>& segments,
            const SegmentRows& rows, double slack, NearLists& lists)
      : lattice_(lattice),
        tile_(tile),
        segments_(segments),
        rows_(rows),
        slack_(static_cast<float>(2 * slack)),
        reach_(first_reach * lattice.pitch + 2 * slack),
        lists_(lists) {
    for (std::size_t b = lattice.first_block(tile); b < lattice.last_block(tile); ++b) {
      circles_.push_back(circle_around(lattice, lattice.blocks[b]));
    }
  }

  /// Searches as far around the blocks as turns out to be needed.
  void run() {
    for (double needed = look(); needed > reach_; needed = look()) {
      reach_ = std::min(headroom * needed, 2 * reach_);
    }
    lists_.entries.assign(entries_.begin(),
                          entries_.end());  // without spare capacity: there are many tiles
  }

 private:
  /// A half-open range of entries in a row of squares, and where it begins in the arrays of the tile.
  struct Run {
    std::ptrdiff_t row;
    std::size_t begin, end, local;
  };

  Box box_of(std::size_t first, std::size_t last) const {
    Box box{Vec2::Constant(infinite), Vec2::Constant(-infinite)};
    for (std::size_t c = first; c < last; ++c) {
      box.min = box.min.cwiseMin(Vec2(circles_[c].x, circles_[c].y));
      box.max = box.max.cwiseMax(Vec2(circles_[c].x, circles_[c].y));
    }
    const Vec2 margin = Vec2::Constant(reach_ + rows_.half_length());
    return {box.min + tile_.corner - margin, box.max + tile_.corner + margin};
  }

  /// Lists the segments within reach; returns the reach that the most demanding circle needs.
  double look() {
    gather();
    entries_.clear();
    lists_.start.assign(1, 0);
    double needed = 0;
    const std::size_t first_block = lattice_.first_block(tile_);
    for (std::size_t group = tile_.first_group; group < tile_.last_group; ++group) {
      const std::size_t first = lattice_.group_start[group] - first_block,
                        last = lattice_.group_start[group + 1] - first_block;
      choose_ranges(box_of(first, last));
      for (std::size_t c = first; c < last; ++c)
        needed = std::max(needed, list_for(circles_[c], lattice_.blocks[first_block + c]));
      if (needed > reach_) break;
    }
    return needed;
  }

  void gather() {
    lists_.segments.clear();
    arrays_.clear();
    local_.clear();
    runs_.clear();
    const Box box = box_of(0, circles_.size());
    const std::ptrdiff_t from = rows_.column(box.min.x()), to = rows_.column(box.max.x());
    for (std::ptrdiff_t row = rows_.row(box.min.y()); row <= rows_.row(box.max.y()); ++row) {
      runs_.push_back({row, rows_.begin(row, from), rows_.end(row, to), lists_.segments.size()});
      for (std::size_t k = runs_.back().begin; k < runs_.back().end; ++k) add(rows_.order()[k]);
    }
    first_long_ = lists_.segments.size();
    const double half = rows_.half_length();
    for (const std::int32_t s : rows_.longer()) {
      const Segment& segment = segments_[static_cast<std::size_t>(s)];
      const Vec2 low = segment.a.cwiseMin(segment.b), high = segment.a.cwiseMax(segment.b);
      if ((low.array() <= box.max.array() + half).all() && (high.array() >= box.min.array() - half).all())
        add(s);
    }
    arrays_.pad();
    distance2_.resize(arrays_.ax.size() + Lattice::lanes * (runs_.size() + 1));
  }

  void add(std::int32_t segment) {
    lists_.segments.push_back(segment);
    local_.push_back(in_tile(segments_[static_cast<std::size_t>(segment)], tile_.corner));
    arrays_.add(local_.back());
  }

  /// Chooses the parts of the tile's runs that lie in the box of a group.
  void choose_ranges(const Box& box) {
    ranges_.clear();
    const std::ptrdiff_t from = rows_.column(box.min.x()), to = rows_.column(box.max.x());
    const std::ptrdiff_t low = rows_.row(box.min.y()), high = rows_.row(box.max.y());
    for (const Run& run : runs_) {
      if (run.row < low || run.row > high) continue;
      const std::size_t begin = std::max(rows_.begin(run.row, from), run.begin),
                        end = std::min(rows_.end(run.row, to), run.end);
      if (begin < end) ranges_.emplace_back(run.local + begin - run.begin, run.local + end - run.begin);
    }
    if (first_long_ < lists_.segments.size()) ranges_.emplace_back(first_long_, lists_.segments.size());
  }

  /// A range of distances takes up whole vectors, whose last lanes are infinite.
  static std::size_t padded(std::size_t count) {
    return (count + Lattice::lanes - 1) / Lattice::lanes * Lattice::lanes;
  }

  /// Lists what may be nearest within the circle, and of that what may be nearest to a sample.
  double list_for(const Circle& circle, const Lattice::Block& block) {
    std::size_t count = 0;
    float nearest2 = infinite;
    for (const auto& [begin, end] : ranges_) {
      nearest2 = std::min(nearest2, distances_from(circle.x, circle.y, &arrays_.ax[begin], &arrays_.ay[begin],
                                                   &arrays_.ux[begin], &arrays_.uy[begin],
                                                   &arrays_.inverse[begin], end - begin, &distance2_[count]));
      count += padded(end - begin);
    }
    const float limit = (std::sqrt(nearest2) + 2 * circle.radius + slack_) * (1 + rounding);
    const std::size_t before = entries_.size();
    std::size_t kept = before;
    entries_.resize(kept + count + Lattice::lanes);
    count = 0;
    for (const auto& [begin, end] : ranges_) {
      kept += numbers_within(&distance2_[count], end - begin, limit * limit, static_cast<std::int32_t>(begin),
                             entries_.data() + kept);
      count += padded(end - begin);
    }
    const Lattice::BorderBlock* border =
        block.border < 0 ? nullptr : &lattice_.borders[static_cast<std::size_t>(block.border)];
    kept = before + keep_near(block, border, static_cast<float>(lattice_.pitch), local_.data(), slack_,
                              entries_.data() + before, kept - before, scratch_);
    entries_.resize(kept);
    lists_.start.push_back(static_cast<std::uint32_t>(kept));
    return limit;
  }

  const Lattice& lattice_;
  const Lattice::Tile& tile_;
  const std::vector<Segment>& segments_;
  const SegmentRows& rows_;
  float slack_;
  double reach_;
  NearLists& lists_;
  std::vector<Circle> circles_;  ///< per block
  std::vector<Run> runs_;
  std::size_t first_long_ = 0;
  SegmentArrays arrays_;
  std::vector<TileSegment> local_;  ///< the same, one after the other
  std::vector<float> scratch_;
  std::vector<std::pair<std::size_t, std::size_t>> ranges_;
  std::vector<float> distance2_;
  std::vector<std::int32_t> entries_;
};

}  // namespace

TileSegment in_tile(const Segment& segment, const Vec2& corner) {
  const Vec2 a = segment.a - corner, u = segment.b - segment.a;
  const double length2 = u.squaredNorm();
  return {static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(u.x()),
          static_cast<float>(u.y()), length2 > 0 ? static_cast<float>(1 / length2) : 0.0F};
}

void make_near_lists(const Lattice& lattice, const Lattice::Tile& tile, const std::vector<Segment>& segments,
                     const SegmentRows& rows, double slack, NearLists& lists) {
  ListMaker(lattice, tile, segments, rows, slack, lists).run();
}

}  // namespace unicursal::core
