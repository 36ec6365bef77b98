// The lines around the layers: those that make a printer ready and those that leave it safe.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// Comments for people and viewers: program, printer, mixtures.
std::vector<std::string> job_comments(const Printer& printer, const PrintSettings& settings,
                                      const Dialect& dialect);

/// Chooses the extruder, sets the inactivity shutdown, resets speed and flow factors, heats and homes. Bed
/// and nozzle heat up while the axes home, which saves a minute. The waits follow, so that plastic that oozes
/// meanwhile stays away from the bed.
std::vector<std::string> warm_up(const Printer& printer, const PrintSettings& settings);

/// The commands of a user's script, with the job's numbers inserted. `key` names it in messages. Throws
/// core::DataError (placeholders.hpp, checks.hpp).
std::vector<std::string> script_lines(const std::string& text, const std::string& key, const Printer& printer,
                                      const PrintSettings& settings);

/// The user's lines between their comments; empty without lines.
std::vector<std::string> framed(const std::vector<std::string>& user_lines);

/// The changes of fan and heaters at the beginning of a layer of a part. The print does not wait for them.
std::vector<std::string> layer_events(std::size_t layer, const PrintSettings& settings);

/// Sets fan and heaters as for the first layer of the first part, before another part is begun; waits for the
/// heat.
std::vector<std::string> next_part_events(const Printer& printer, const PrintSettings& settings);

/// Sets extruder, inactivity shutdown and modes again, in case the user's own lines have changed them.
std::vector<std::string> after_user_start(const Printer& printer);

/// Heaters and fan off, the user's end lines, heaters and fan off again in case these lines turned them on,
/// motors off. The inactivity shutdown ends last; it would halt an idle printer half an hour after every
/// print.
std::vector<std::string> shut_down(const std::vector<std::string>& user_lines);

}  // namespace unicursal::gcode
