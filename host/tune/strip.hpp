// The geometry of the strip from which a transition is read: lanes that fill the nozzle with the first
// mixture; the round marks by which a photo is read, the ticks and the numbers; then one unbroken bead. From
// the front of the bed to the back, the bead consists of
//
//   four reference lines, of 5, 50, 95 and 100 % of the change (transition_fit.hpp) and marked with these
//   numbers, each after lanes that fill the nozzle with its mixture; lanes that fill the nozzle with the
//   first mixture again; the strip itself: some of the first mixture, then the switch at tick 0, and ticks up
//   to the end.
//
// The lanes before a line hold as much as the strip does, so that the nozzle is full of the line's mixture
// for any volumes of its chamber. The strip is thin at first and then fat: a tick is worth at most 2 %
// of what has passed. So small volumes can be read as finely as the nozzle allows, and large ones do not need
// metres. Even ticks are behind the bead and odd ones in front of it, because lines as thick as the nozzle's
// opening must stay apart. If the bed is too short, the strip turns and comes back; the turn counts, and has
// only even ticks. All sizes follow from the nozzle's opening. mm, mm³, in the frame of the bed.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "host/photo/marks.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

/// The mixtures that are fed; their values are the numbers of their virtual tools.
enum class Shade : std::size_t { from, began, half, stopped, to };
inline constexpr std::size_t shade_count = 5;
/// How far each has gone from the first mixture to the second.
inline constexpr std::array<double, shade_count> shade_shares = {0, perception.began, perception.half,
                                                                 perception.stopped, 1};

struct StripMove {
  core::Vec2 to{0, 0};
  double volume = 0;
  Shade shade = Shade::from;
};

struct Strip {
  struct Point {
    core::Vec2 place{0, 0};
    double passed = 0;  ///< volume since the switch, mm³
  };

  /// A straight piece of the bead, and what is printed there. Where it is pure, the nozzle was full of its
  /// mixture.
  struct Lane {
    core::Vec2 from{0, 0}, to{0, 0};
    double width = 0;
    Shade shade = Shade::from;
    bool pure = false;
  };

  double layer_height = 0;
  double tick = 0;                             ///< distance of ticks along the bead
  double line_width = 0;                       ///< of ticks and numbers
  double thin_width = 0, fat_width = 0;        ///< of the bead: least and greatest
  std::size_t lanes = 0;                       ///< number of lanes of the strip itself
  std::vector<Point> points;                   ///< one per tick, from the switch at tick 0
  std::vector<std::size_t> marked;             ///< ticks that are printed, ascending
  MarkPlaces round_marks{};                    ///< middles of the round marks around everything else
  std::vector<std::vector<core::Vec2>> marks;  ///< all marks as open lines, in the order of printing
  core::Vec2 purge_start{0, 0}, start{0, 0};   ///< of the lanes before the marks, and of the bead
  std::vector<StripMove> purge, bead;
  /// The bead and the lanes before the marks, up to the switch; and the ticks, in the first mixture.
  std::vector<Lane> straight, ticks;
  std::array<core::Vec2, 3> references;  ///< where the lines of 5, 50 and 95 % have their pure mixture

  /// Length from the switch to the end of the strip, mm.
  double length() const { return tick * static_cast<double>(points.size() - 1); }
  /// The point `along` mm from the switch, 0 to length().
  Point at(double along) const;
  double volume() const { return points.back().passed; }
};

/// Makes a strip through which `range` mm³ pass after the switch; without `range`, 60 mm³ or as much as fits
/// on the bed. Throws core::DataError if it does not fit.
Strip make_strip(const gcode::Printer& printer, const std::optional<double>& range);

}  // namespace unicursal::host
