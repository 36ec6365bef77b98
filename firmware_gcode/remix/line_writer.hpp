// Writes a file's moves again, in absolute positions and relative filament, with the mixture that is to be
// fed. mm, mm/min, mm³.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/sliced/step.hpp"

namespace unicursal::gcode {

class LineWriter {
 public:
  /// Both must outlive the writer.
  LineWriter(const Printer& printer, const Dialect& dialect) : printer_(printer), dialect_(dialect) {}

  /// Sets the content of a tool and the name of its mixture.
  void define_tool(std::size_t tool, std::string name, const CalibratedMixture& mixture);
  /// Precondition: the tool is defined.
  void select_tool(Chunk& chunk, std::size_t tool);

  /// Moves to a place, as far as it is known, and feeds filament meanwhile (negative: draws it back). `feed`
  /// 0: that in force.
  void move(Chunk& chunk, const Place& to, double filament, double feed);
  /// A line as it is. Afterwards nothing is taken to be known of position and feed rate.
  void pass(Chunk& chunk, const std::string& line);
  void forget();

  /// Where the nozzle was sent last, as far as that is known.
  const Place& place() const { return place_; }

 private:
  double scale() const;
  void line(Chunk& chunk, const Place& to, double filament, double feed);

  struct Tool {
    std::string name;
    CalibratedMixture mixture;
  };

  const Printer& printer_;
  const Dialect& dialect_;
  std::map<std::size_t, Tool> tools_;
  std::optional<std::size_t> tool_;
  Place place_{}, written_{};
  double feed_ = 0;  ///< in force; 0: unknown
  double owed_ = 0;  ///< mm of filament that rounding has withheld
};

}  // namespace unicursal::gcode
