// Writes moves as lines and remembers what a firmware remembers: position, feed rate, tool.
// Lengths in mm, speeds in mm/s, volumes in mm³; E is mm of filament, all feeders together, relative (M83).
//
// Resolution: positions are written in 0.001 mm, E in 0.00001 mm. What rounding takes from one bead's E is
// added to the next, so that their sum is exact. A feed rate is written only when it differs by more than
// 1 % from the one in force; it keeps to the axes' limits along the way that is written. Coordinates that do
// not change are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class MoveWriter {
 public:
  /// Both must outlive the writer. Preconditions: a checked printer (checks.hpp).
  MoveWriter(const Printer& printer, const Dialect& dialect);

  /// Where the nozzle is; none until the first travel.
  std::optional<core::Vec2> position() const;
  /// Height of the nozzle; none until the first rise.
  std::optional<double> height() const;

  /// From here on nothing is taken to be known: the next move states everything that it depends on. For a
  /// printer that may have stopped anywhere in what has been written.
  void forget();

  /// What a tool holds from here on: `name` for people, and E ÷ the filament that is to be fed
  /// (mixing/calibration.hpp).
  void define_tool(std::size_t tool, std::string name, double scale);

  /// The chunk records the mixture that starts here.
  void select_tool(Chunk& chunk, std::size_t tool);
  void rise(Chunk& chunk, double z);
  void travel(Chunk& chunk, const core::Vec2& to);
  /// Extrudes `volume` on the way. Precondition: a position is known.
  void bead(Chunk& chunk, const core::Vec2& to, double volume, double speed);
  /// Moves filament alone, `length` mm forwards or (negative) back.
  void filament(Chunk& chunk, double length, double speed);

 private:
  struct GridPoint {
    std::int64_t x = 0, y = 0;  ///< in 0.001 mm
  };

  static GridPoint on_grid(const core::Vec2& point);
  void append_position(std::string& line, const GridPoint& to);
  void append_feed(std::string& line, double speed);
  double scale() const;
  void straight_bead(Chunk& chunk, const core::Vec2& to, double volume, double speed);

  const Printer& printer_;
  const Dialect& dialect_;
  double filament_area_;  ///< mm²
  std::optional<GridPoint> position_;
  std::optional<std::int64_t> height_;  ///< in 0.001 mm
  std::optional<std::size_t> tool_;
  struct Tool {
    std::string name;
    double scale = 1;
  };
  std::vector<Tool> tools_;
  double feed_ = 0;  ///< mm/min in force, 0: unknown
  double owed_ = 0;  ///< mm of filament that rounding has kept back
};

}  // namespace unicursal::gcode
