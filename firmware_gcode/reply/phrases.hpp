// The sentences of firmwares that decide what becomes of a print, with the source of each. Firmwares change
// their prefixes from version to version ("Error:", "echo:", none), so only the words themselves count.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace unicursal::gcode {

enum class Meaning {
  stopped,          ///< it acknowledges moves and does none until M999 or a restart; its heaters are off
  refuses_to_move,  ///< it has not carried out a move, since it does not know where its nozzle is
  too_cold,         ///< it has moved without extruding, since the nozzle is too cold
  too_long,         ///< it has moved without extruding, since it takes the extrusion for a mistake
  no_such_tool      ///< it has not changed the tool, since it has fewer
};

struct Phrase {
  Meaning meaning;
  std::string_view begins;    ///< the beginning of the sentence, in lower case; may be empty
  std::string_view contains;  ///< what it contains behind that, in lower case; may be empty
  std::string_view example;   ///< a whole line
  std::string_view source;
};

/// All of them.
std::span<const Phrase> phrases();

/// Returns what a line from the printer means; absent for any other line, and for `//` messages to people.
std::optional<Meaning> meaning_of(std::string_view line);

}  // namespace unicursal::gcode
