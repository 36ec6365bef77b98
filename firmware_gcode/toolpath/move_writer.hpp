// Writes moves as lines and tracks the state of the firmware: position, feed rate, tool. Lengths in mm,
// speeds in mm/s, volumes in mm³; E is mm of filament, all feeders together, relative (M83).
//
// Resolution: positions are written in 0.001 mm, E in 0.00001 mm. The rounding error of a bead's E is added
// to the next bead, so that the sum is exact. A feed rate is written only if it differs by more than 1 % from
// the one in force; it respects the axes' limits along the written way. Unchanged coordinates are omitted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

class MoveWriter {
 public:
  /// Both must outlive the writer. Precondition: the printer is checked (checks.hpp).
  MoveWriter(const Printer& printer, const Dialect& dialect);

  /// The position of the nozzle; absent before the first travel.
  std::optional<core::Vec2> position() const;
  /// The height of the nozzle; absent before the first rise.
  std::optional<double> height() const;

  /// The tool in use; absent before the first one.
  std::optional<std::size_t> tool() const { return tool_; }

  /// Forgets the state, so that the next move writes everything it depends on. Needed if the printer may have
  /// stopped anywhere in the written lines.
  void forget();

  /// Sets the content of a tool, and the name of its mixture.
  void define_tool(std::size_t tool, std::string name, const CalibratedMixture& mixture);

  /// Selects the tool and records the start of its mixture in the chunk. Precondition: the tool is defined.
  void select_tool(Chunk& chunk, std::size_t tool);
  void rise(Chunk& chunk, double z);
  void travel(Chunk& chunk, const core::Vec2& to);
  /// Extrudes `volume` along the way. Precondition: the position is known.
  void bead(Chunk& chunk, const core::Vec2& to, double volume, double speed);
  /// Moves only filament, `length` mm forwards or (if negative) back.
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
    CalibratedMixture mixture;
  };
  std::map<std::size_t, Tool> tools_;
  double feed_ = 0;  ///< mm/min in force, 0: unknown
  double owed_ = 0;  ///< mm of filament that rounding has withheld
};

}  // namespace unicursal::gcode
