// What a terminal can show, by the conventions of the environment: TERM, COLORTERM, and NO_COLOR
// (https://no-color.org).
#pragma once

#include <cstddef>
#include <string>

#include "core/picture/image.hpp"

namespace unicursal::host {

struct TerminalLook {
  enum class Colours {
    none,
    palette,  ///< xterm's 256
    all       ///< 24 bits
  };
  bool rewrites = false;  ///< a line can be erased and written again
  Colours colours = Colours::none;
};

/// Of a descriptor: a pipe, a file and TERM=dumb can do nothing.
TerminalLook look_of(int descriptor);

/// Two columns in this colour; empty without colours.
std::string swatch(picture::Colour colour, TerminalLook::Colours colours);

/// Columns of the terminal behind a descriptor, or of a usual one if they are unknown.
std::size_t terminal_width(int descriptor);

}  // namespace unicursal::host
