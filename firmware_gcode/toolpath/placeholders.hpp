// Placeholders for numbers of the job in the user's own lines, such as "M104 S{nozzle_temperature}".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// The names of all placeholders, without braces.
std::vector<std::string> placeholder_names();

/// The placeholders in `text`, known or not, in order.
std::vector<std::string> placeholders_in(std::string_view text);

/// Replaces the placeholders by numbers. `key` names the text in messages. Throws core::DataError for an
/// unknown name and for an unmatched brace.
std::string with_values(const std::string& text, const std::string& key, const Printer& printer,
                        const PrintSettings& settings);

}  // namespace unicursal::gcode
