// Words in braces that stand for numbers of the job in the user's own lines: "M104 S{nozzle_temperature}".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// All that there are, without braces.
std::vector<std::string> placeholder_names();

/// Those that `text` holds, known or not, in order.
std::vector<std::string> placeholders_in(std::string_view text);

/// The text with numbers in their place. `key` names the text in messages. Throws core::DataError for a name
/// that is not known and for a brace without its partner.
std::string with_values(const std::string& text, const std::string& key, const Printer& printer,
                        const PrintSettings& settings);

}  // namespace unicursal::gcode
