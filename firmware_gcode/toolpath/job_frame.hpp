// What stands around the layers: the lines that make a printer ready and those that leave it safe.
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// For people and viewers: who made the file, for which printer, with which mixtures.
std::vector<std::string> job_comments(const Printer& printer, const PrintSettings& settings,
                                      const Dialect& dialect);

/// Inactivity shutdown, factors reset, heat, home. Bed and nozzle warm up while the axes home, which saves
/// a minute; the waits come after, so that whatever has oozed meanwhile stays away from the bed.
std::vector<std::string> warm_up(const Printer& printer, const PrintSettings& settings);

/// A script of the user's as commands, with the job's numbers in it. `key` names it in messages. Throws
/// core::DataError (placeholders.hpp, checks.hpp).
std::vector<std::string> script_lines(const std::string& text, const std::string& key, const Printer& printer,
                                      const PrintSettings& settings);

/// The user's lines between their comments, if there are any.
std::vector<std::string> framed(const std::vector<std::string>& user_lines);

/// The changes of fan and heaters that a layer begins with. Nothing waits for them.
std::vector<std::string> layer_events(std::size_t layer, const PrintSettings& settings);

/// The inactivity shutdown and the modes once more: the user's own lines cannot turn off the one or change
/// the others under the toolpath.
std::vector<std::string> after_user_start();

/// Heaters and fan off, the user's last lines, the same off again in case these turned them on, motors off.
/// The inactivity shutdown ends last: it would halt an idle printer half an hour after every print.
std::vector<std::string> shut_down(const std::vector<std::string>& user_lines);

}  // namespace unicursal::gcode
