// A look at a slicer's whole file before it is printed: who wrote it, what it uses, how large the part is;
// and whether anything in it would break the print. Everything that a print of the file refuses is refused
// here, before anything heats. mm, mm³, °C, s.
//
//   std::ifstream file("part.gcode", std::ios::binary);
//   const SlicedSurvey survey = survey_sliced(file, "part.gcode", printer, {});
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/sliced/limits.hpp"

namespace unicursal::gcode {

/// A tool of the file. A mixing nozzle prints it with a mixture.
struct SlicedTool {
  int number = 0;
  std::string colour;                   ///< of its filament, "#rrggbb"; empty: the file does not say
  double volume = 0;                    ///< mm³ that it extrudes
  std::optional<Mixture> mixture = {};  ///< that the file itself gives it (M163, M165, M567)
};

struct SlicedSurvey {
  std::string slicer;             ///< such as "PrusaSlicer 2.5.0"; empty: unknown
  std::vector<SlicedTool> tools;  ///< those that extrude, by number
  std::size_t layers = 0;         ///< at least 1
  double first_layer_height = 0, layer_height = 0;
  core::Box extent;         ///< of all that is laid, tower and skirt included, without the user's lines
  double height = 0;        ///< greatest z at which plastic is laid
  double volume = 0;        ///< mm³ fed beyond what was drawn back
  double tower_volume = 0;  ///< mm³ of it in the wipe tower
  double seconds = 0;       ///< estimated, without heating
  std::vector<double> layer_seconds;
  std::vector<double> tower_seconds;  ///< of these, in the wipe tower
  double nozzle = 0, bed = 0;         ///< highest targets
  std::size_t changes = 0;            ///< of tool, between beads
  bool marked = false;                ///< comments mark the layers
  std::uint64_t lines = 0;
  std::uint64_t last_bead = 0;  ///< line of the last move that lays plastic; what follows is the file's end
  std::vector<std::string> notes;  ///< for the user, one sentence each
};

/// `name` is that of the file, for messages. Reads to the end; memory does not grow with the file. Throws
/// core::DataError, which names the line, for a file that is not G-code of a slicer, and for what would break
/// the print. `stop` is called now and then; it may throw.
SlicedSurvey survey_sliced(std::istream& file, const std::string& name, const Printer& printer,
                           const SlicedLimits& limits, const std::function<void()>& stop = {});

}  // namespace unicursal::gcode
