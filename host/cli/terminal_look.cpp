#include "host/cli/terminal_look.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string_view>

namespace unicursal::host {
namespace {

constexpr std::size_t usual_width = 100;

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

TerminalLook::Colours colours_here() {
  using Colours = TerminalLook::Colours;
  if (!variable("NO_COLOR").empty()) return Colours::none;
  const std::string_view kind = variable("COLORTERM");
  if (kind == "truecolor" || kind == "24bit") return Colours::all;
  return variable("TERM").find("256color") != std::string_view::npos ? Colours::palette : Colours::none;
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
  const std::string_view kind = variable("TERM");
  if (isatty(descriptor) != 1 || kind == "dumb") return {};
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
