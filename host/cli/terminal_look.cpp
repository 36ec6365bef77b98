#include "host/cli/terminal_look.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "host/files/environment.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t usual_width = 100;

TerminalLook::Colours colours_here() {
  using Colours = TerminalLook::Colours;
  if (environment("NO_COLOR")) return Colours::none;
  const std::string kind = environment("COLORTERM").value_or("");
  if (kind == "truecolor" || kind == "24bit") return Colours::all;
  return environment("TERM").value_or("").find("256color") != std::string::npos ? Colours::palette
                                                                                : Colours::none;
}

/// The nearest entry of the 6 × 6 × 6 colours of the palette, whose levels are 0, 95, 135, 175, 215, 255.
int palette_entry(picture::Colour colour) {
  const auto level = [](unsigned char value) {
    return value < 48 ? 0 : value < 115 ? 1 : static_cast<int>(std::lround((value - 55) / 40.0));
  };
  return 16 + 36 * level(colour.r) + 6 * level(colour.g) + level(colour.b);
}

}  // namespace

TerminalLook look_of(int descriptor) {
  if (isatty(descriptor) != 1 || environment("TERM") == "dumb") return {};
  return {true, colours_here()};
}

std::string swatch(picture::Colour colour, TerminalLook::Colours colours) {
  switch (colours) {
    case TerminalLook::Colours::all:
      return fmt::format("\x1b[48;2;{};{};{}m  \x1b[0m", colour.r, colour.g, colour.b);
    case TerminalLook::Colours::palette:
      return fmt::format("\x1b[48;5;{}m  \x1b[0m", palette_entry(colour));
    case TerminalLook::Colours::none:
      break;
  }
  return {};
}

std::size_t terminal_width(int descriptor) {
  winsize size{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : usual_width;
}

}  // namespace unicursal::host
