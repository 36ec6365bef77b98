#include "host/engine/printer_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <variant>

#include "core/error.hpp"
#include "core/text/wording.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/reply/reply.hpp"

namespace unicursal::host {

namespace {

constexpr auto marlins_question = "M163 S99 P1";

bool asks_tools(const std::string& firmware) {
  return gcode::share_writing(gcode::dialect_named(firmware)) != nullptr;
}

}  // namespace

std::string mixing_question(const std::string& firmware) {
  return asks_tools(firmware) ? "M567 P0" : marlins_question;
}

bool denies_mixing(const std::string& line) {
  const gcode::Reply reply = gcode::parse_reply(line);
  if (const auto* error = std::get_if<gcode::reply::Error>(&reply)) return error->text.starts_with("M567: ");
  const auto* echo = std::get_if<gcode::reply::Echo>(&reply);
  return echo && echo->unknown_command &&
         (echo->text.find(marlins_question) != std::string::npos || echo->text.starts_with("M567: "));
}

std::optional<std::size_t> mixing_feeders(const std::string& line) {
  constexpr std::string_view words = " mix ratios: ";
  const auto at = line.find(words);
  if (!line.starts_with("Tool ") || at == std::string::npos) return std::nullopt;
  const auto shares = std::string_view(line).substr(at + words.size());
  return 1 + static_cast<std::size_t>(std::count(shares.begin(), shares.end(), ':'));
}

std::string does_not_mix(const std::string& firmware) {
  if (!asks_tools(firmware))
    return "its feeders do not mix: it does not know M163; build its firmware with MIXING_EXTRUDER";
  return "it has no tool 0; define one with all feeders in its config.g, for example M563 P0 D0:1:2 H1";
}

std::string mixes_other_feeders(std::size_t has, std::size_t wanted) {
  return fmt::format(
      "{} {} in its tool 0, but the profile says {}; correct the drives in its config.g (M563 P0 D0:1:2), or "
      "extruder.feeders in the profile",
      has, has == 1 ? "feeder meets" : "feeders meet", wanted);
}

std::optional<unsigned> highest_tool(const std::vector<std::string>& lines) {
  constexpr std::string_view stores = "M164 S";
  std::optional<unsigned> highest;
  for (const std::string& line : lines) {
    unsigned tool = 0;
    if (!line.starts_with(stores)) continue;
    const auto [end, error] = std::from_chars(line.data() + stores.size(), line.data() + line.size(), tool);
    if (error == std::errc()) highest = std::max(highest.value_or(tool), tool);
  }
  return highest;
}

std::string lacks_tools(unsigned highest) {
  return fmt::format(
      "it has fewer virtual tools than the {0} that this print needs; build its firmware with "
      "MIXING_VIRTUAL_TOOLS {0}, or use fewer mixtures",
      highest + 1);
}

std::optional<std::string> has_other_feeders(const gcode::Identity& printer, std::size_t wanted) {
  if (printer.family != gcode::Family::repetier || !printer.extruders) return std::nullopt;
  if (*printer.extruders == wanted) return std::nullopt;
  return fmt::format(
      "it has {} feeders, but the profile says {}; set NUM_EXTRUDER in its firmware, or extruder.feeders in "
      "the "
      "profile",
      *printer.extruders, wanted);
}

std::optional<std::string> dialect_of(gcode::Family family) {
  const std::string word = core::lower(gcode::name(family));
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
