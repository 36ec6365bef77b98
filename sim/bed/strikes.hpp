// Whether the head strikes what it has laid: the nozzle's tip passes through plastic that is higher than it,
// or the head around the nozzle does. This happens while one part is printed beside another that is finished.
//
// Model: the head is two bodies around the nozzle's axis. The lower one has the radius `radius` and reaches
// down to the tip; the upper one is endless in x and y and begins `height` above the tip. Plastic stands
// where the centre lines of beads ran, up to the nozzle's height there. Departure from reality: between its
// edge and the nozzle a real head is above the tip, so that this model strikes more. mm.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

struct HeadShape {
  double radius = 0, height = 0;
};

class Strikes {
 public:
  /// `head` absent: only the tip can strike.
  explicit Strikes(const std::optional<HeadShape>& head) : head_(head) {}

  void laid(const Position& from, const Position& to);
  void travelled(const Position& from, const Position& to);

  std::uint64_t by_nozzle() const { return by_nozzle_; }  ///< Moves on which the tip struck.
  std::uint64_t by_head() const { return by_head_; }      ///< Moves on which only the head struck.
  /// Place of the nozzle at the first strike.
  const std::optional<Position>& first() const { return first_; }

 private:
  struct Cell {
    double top = 0;
    double min_x = 0, min_y = 0, max_x = 0, max_y = 0;  ///< Of the beads in the cell.
  };

  void check(const Position& from, const Position& to);
  bool tip_strikes(const Position& at) const;
  bool head_strikes(const Position& at) const;
  void note(std::uint64_t& count, const Position& at);

  std::optional<HeadShape> head_;
  std::unordered_map<std::uint64_t, double> fine_;  ///< Tops, by square of fine_pitch.
  std::unordered_map<std::uint64_t, Cell> coarse_;  ///< By square of coarse_pitch.
  double highest_ = 0;
  std::uint64_t by_nozzle_ = 0, by_head_ = 0;
  std::optional<Position> first_;
};

}  // namespace unicursal::sim
