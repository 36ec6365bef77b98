#include "host/engine/printer_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <variant>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect.hpp"
#include "firmware_gcode/reply/reply.hpp"

namespace unicursal::host {

bool denies_mixing(const std::string& line) {
  const gcode::Reply reply = gcode::parse_reply(line);
  const auto* echo = std::get_if<gcode::reply::Echo>(&reply);
  return echo && echo->unknown_command && echo->text.find(mixing_question) != std::string::npos;
}

std::optional<std::string> dialect_of(gcode::Family family) {
  std::string word(gcode::name(family));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  try {
    gcode::dialect_named(word);
    return word;
  } catch (const core::DataError&) {
    return std::nullopt;
  }
}

std::optional<std::string> mismatch(const gcode::Identity& printer, const std::string& firmware) {
  const auto spoken = dialect_of(printer.family);
  if (!spoken || *spoken == firmware) return std::nullopt;
  return fmt::format("its firmware is {}, which misreads mixtures that are written for firmware = \"{}\"",
                     gcode::name(printer.family), firmware);
}

std::string correction(const gcode::Identity& printer, const std::filesystem::path& profile) {
  return fmt::format("set firmware = \"{}\" in {}, or choose another printer",
                     dialect_of(printer.family).value_or("marlin"),
                     profile.empty() ? "its profile" : profile.string());
}

std::optional<std::string> strangeness(const gcode::Identity& printer) {
  if (dialect_of(printer.family)) return std::nullopt;
  return fmt::format(
      "this program has never met this printer's firmware ({}): the print may fail in "
      "unexpected ways, so stay with the printer",
      printer.firmware.empty() ? "it does not report its name" : printer.firmware);
}

}  // namespace unicursal::host
