// A square lattice of sample points over a polygon, for integrals over the island: each sample stands for
// the piece of its square that lies inside, with that piece's exact area and centroid. mm, mm².
//
// Know its limits: an axis-aligned lattice resonates with parallel folds, so callers rotate the polygon by
// an irrational angle first, and the exact segment diagram, never the lattice, decides a final figure.
//
// Samples come in blocks of eight, for eight lanes of a vector, blocks in groups and groups in tiles, each
// near one another. Blocks wholly outside are left out, and only those on the border store positions and
// weights: a sample costs a few bytes at most.
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
    float x = 0, y = 0;        ///< lower left corner, relative to the tile's
    std::int32_t tile = 0;     ///< in `tiles`
    std::int32_t border = -1;  ///< in `borders`; −1 for a block wholly inside
  };
  /// Samples of a block that the border passes through. Positions are relative to the tile's corner.
  struct BorderBlock {
    std::array<float, lanes> x{}, y{};
    std::array<float, lanes> weight{};  ///< mm²; 0 where the square lies outside
  };
  struct Tile {
    Vec2 corner{0, 0};
    std::size_t first_group = 0, last_group = 0;  ///< half-open, in `group_start`
  };

  double pitch = 0;  ///< side of a square
  std::vector<Block> blocks;
  std::vector<BorderBlock> borders;
  std::vector<std::size_t> group_start;  ///< first block of every group, and one entry more
  std::vector<Tile> tiles;

  /// Samples, those without weight included.
  std::size_t size() const { return lanes * blocks.size(); }
  double weight(std::size_t sample) const {
    const Block& block = blocks[sample / lanes];
    return block.border < 0 ? static_cast<float>(pitch * pitch)
                            : borders[static_cast<std::size_t>(block.border)].weight[sample % lanes];
  }
  Vec2 position(std::size_t sample) const;
  /// Blocks of a tile, half-open.
  std::size_t first_block(const Tile& tile) const { return group_start[tile.first_group]; }
  std::size_t last_block(const Tile& tile) const { return group_start[tile.last_group]; }
  double total_weight() const;
};

/// Precondition: pitch > 0. Throws std::length_error beyond 2^31 squares.
Lattice sample(const Polygon& polygon, double pitch);

}  // namespace unicursal::core
