// The strip that a transition is read from, as geometry on the bed: one unbroken bead and, printed before it,
// the ticks and numbers beside it. From the front of the bed to the back the bead is laid as
//
//   three lines to compare with, of 5, 50 and 95 % of the change (response.hpp), marked with these numbers,
//   each after lanes that fill the nozzle with its mixture;
//   lanes that fill the nozzle with the first mixture again;
//   the strip itself: some of the first mixture, then, at tick 0, the switch, and ticks to the end.
//
// Every lane before a pure place holds as much as the strip does, so that the nozzle is full of its mixture
// however large its volumes are. The strip is thin at first and becomes thicker: a tick is worth at most 2 %
// of what has passed, so that small volumes can be read as finely as the nozzle allows and large ones need no
// metres. Even ticks stand behind the bead, odd ones in front of it: lines as thick as the nozzle's opening
// stay apart. Where the bed is too short, the strip turns and comes back; the turn counts, and has even ticks
// only. All sizes follow from the nozzle's opening. mm, mm³, bed's frame.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

/// What flows into the nozzle; also the numbers of their virtual tools.
enum class Shade : std::size_t { from, began, half, stopped, to };
inline constexpr std::size_t shade_count = 5;

struct StripMove {
  core::Vec2 to{0, 0};
  double volume = 0;
  Shade shade = Shade::from;
};

struct Strip {
  struct Point {
    core::Vec2 place{0, 0};
    double passed = 0;  ///< mm³ since the switch
  };

  double layer_height = 0;
  double tick = 0;                             ///< from one tick to the next, along the bead
  double line_width = 0;                       ///< of ticks and numbers
  std::size_t lanes = 0;                       ///< of the strip itself
  std::vector<Point> points;                   ///< tick by tick, from the switch at 0
  std::vector<std::size_t> marked;             ///< ticks that are printed, ascending
  std::vector<std::vector<core::Vec2>> marks;  ///< ticks and numbers as open lines, in order of printing
  core::Vec2 start{0, 0};                      ///< of the bead
  std::vector<StripMove> bead;                 ///< all of it
  std::array<core::Vec2, 3> references;        ///< where the lines to compare with are pure

  /// mm from the switch to the strip's end.
  double length() const { return tick * static_cast<double>(points.size() - 1); }
  /// What is `along` mm from the switch, 0 to length().
  Point at(double along) const;
  double volume() const { return points.back().passed; }
};

/// A strip that `range` mm³ pass through after the switch; if none is given, 60 or as much as the bed holds.
/// Throws core::DataError when it does not fit on the bed.
Strip make_strip(const gcode::Printer& printer, const std::optional<double>& range);

}  // namespace unicursal::host
