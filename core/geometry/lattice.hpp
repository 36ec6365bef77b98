// A square lattice of sample points over a polygon, for integrals over the island. Each sample stands for the
// part of its square that lies inside, and has that part's exact area and centroid. mm, mm².
//
// Its limits: an axis-aligned lattice resonates with parallel folds, so callers first rotate the polygon by
// an irrational angle. Final figures always come from the exact segment diagram, never from the lattice.
//
// Eight neighbouring samples form a block, for eight lanes of a vector; neighbouring blocks form groups, and
// groups form tiles. Blocks wholly outside are left out, and only blocks on the border store positions and
// weights, so a sample costs a few bytes at most.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct Lattice {
  static constexpr std::size_t block_columns = 4, block_rows = 2;
  static constexpr std::size_t lanes = block_columns * block_rows;

  struct Block {
    float x = 0, y = 0;        ///< lower left corner, relative to that of the tile
    std::int32_t tile = 0;     ///< index in `tiles`
    std::int32_t border = -1;  ///< index in `borders`; −1 for a block wholly inside
  };
  /// The samples of a block that the border crosses. Positions are relative to the corner of the tile.
  struct BorderBlock {
    std::array<float, lanes> x{}, y{};
    std::array<float, lanes> weight{};  ///< mm²; 0 if the square lies outside
  };
  struct Tile {
    Vec2 corner{0, 0};
    std::size_t first_group = 0, last_group = 0;  ///< half-open range in `group_start`
  };

  double pitch = 0;  ///< side of a square
  std::vector<Block> blocks;
  std::vector<BorderBlock> borders;
  std::vector<std::size_t> group_start;  ///< first block of every group, and the end of the last
  std::vector<Tile> tiles;

  /// Number of samples, including those without weight.
  std::size_t size() const { return lanes * blocks.size(); }
  double weight(std::size_t sample) const {
    const Block& block = blocks[sample / lanes];
    return block.border < 0 ? static_cast<float>(pitch * pitch)
                            : borders[static_cast<std::size_t>(block.border)].weight[sample % lanes];
  }
  Vec2 position(std::size_t sample) const;
  /// The blocks of a tile, as a half-open range.
  std::size_t first_block(const Tile& tile) const { return group_start[tile.first_group]; }
  std::size_t last_block(const Tile& tile) const { return group_start[tile.last_group]; }
  double total_weight() const;
};

/// Precondition: pitch > 0. Throws std::length_error for more than 2^31 squares.
Lattice sample(const Polygon& polygon, double pitch);

}  // namespace unicursal::core
