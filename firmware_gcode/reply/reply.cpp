#include "firmware_gcode/reply/reply.hpp"

#include <charconv>
#include <cmath>

#include "core/text/printable.hpp"
#include "firmware_gcode/reply/phrases.hpp"

namespace unicursal::gcode {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Removes `prefix` from the front if it is there.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// Reads a number at the front, after optional spaces; nullopt if there is none or if it is too large.
std::optional<std::uint32_t> take_count(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::optional<double> take_decimal(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Returns the text behind `label` where the label begins a word; empty if it does not occur.
std::string_view after_label(std::string_view text, std::string_view label) {
  for (auto at = text.find(label); at != std::string_view::npos; at = text.find(label, at + 1)) {
    if (at == 0 || is_space(text[at - 1])) return text.substr(at + label.size());
  }
  return {};
}

Temperatures temperatures_in(std::string_view text) {
  Temperatures result;
  const auto read = [&](std::string_view label, auto& now, auto& target) {
    std::string_view rest = after_label(text, label);
    now = take_decimal(rest);
    if (now && take(rest = without_blanks(rest), "/")) target = take_decimal(rest);
  };
  read("T:", result.nozzle, result.nozzle_target);
  if (!result.nozzle)
    read("T0:", result.nozzle, result.nozzle_target);  // RepRapFirmware without a chosen tool
  read("B:", result.bed, result.bed_target);
  return result;
}

reply::Ok ok_with(std::string_view rest) {
  reply::Ok ok;
  ok.temperatures = temperatures_in(rest);
  if (!ok.temperatures.empty()) return ok;
  for (rest = without_blanks(rest); !rest.empty(); rest = without_blanks(rest)) {
    if (take(rest, "N"))
      ok.line = take_count(rest);
    else if (take(rest, "P"))
      ok.planner_places = take_count(rest);
    else if (take(rest, "B"))
      ok.command_places = take_count(rest);
    else if (const auto number = take_count(rest))
      ok.line = number;
    else
      break;
  }
  return ok;
}

reply::Error error_with(std::string_view rest) {
  reply::Error error{std::string(without_blanks(rest)), std::nullopt, false};
  if (std::string_view tail = after_label(rest, "Last Line:"); !tail.empty()) {
    error.last_line = take_count(tail);
  }
  error.halted =
      rest.find("halted") != std::string_view::npos || rest.find("kill()") != std::string_view::npos;
  return error;
}

/// The part of "X:1.00 Y:2.00 Z:3.00 E:0.00 Count X:80 …" before the step counts.
reply::Position position_with(std::string_view text) {
  reply::Position position{std::string(text), std::nullopt};
  std::array<double, 3> mm{};
  constexpr std::array<std::string_view, 3> labels{"X:", "Y:", "Z:"};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::string_view rest = after_label(text.substr(0, text.find("Count")), labels[i]);
    const auto value = take_decimal(rest);
    if (!value) return position;
    mm[i] = *value;
  }
  position.mm = mm;
  return position;
}

/// "AUTOREPORT_TEMP:1" behind "Cap:".
Reply capability_with(std::string_view rest, std::string_view whole) {
  constexpr std::size_t longest = 40;
  const auto colon = rest.find(':');
  const std::string_view value = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  if (colon == 0 || colon > longest || (value != "0" && value != "1"))
    return reply::Unknown{std::string(whole)};
  return reply::Capability{core::printable(rest.substr(0, colon)), value == "1"};
}

/// "Warning: M155: Command is not supported" and other words of RepRapFirmware that do not stop it.
Reply warning_with(std::string_view rest) {
  return reply::Echo{std::string(without_blanks(rest)), rest.ends_with(": Command is not supported")};
}

bool ends_word(std::string_view rest) {
  return rest.empty() || is_space(rest.front());
}

}  // namespace

Reply parse_reply(std::string_view line) {
  const std::string_view whole = without_blanks(line);
  std::string_view rest = whole;
  if (rest.empty()) return reply::Blank{};
  if (take(rest, "ok") && ends_word(rest)) return ok_with(rest);
  rest = whole;
  if (take(rest, "Resend:") || take(rest, "rs ")) {
    if (const auto number = take_count(rest); number && ends_word(rest)) return reply::Resend{*number};
    return reply::Unknown{std::string(whole)};
  }
  const bool error = take(rest, "Error:");
  if (meaning_of(whole) == Meaning::stopped)
    return reply::Error{std::string(without_blanks(rest)), std::nullopt, true};
  // RepRapFirmware's words for commands that it does not know.
  if (error && rest.starts_with(" Bad command:")) return reply::Echo{std::string(without_blanks(rest)), true};
  if (error) return error_with(rest);
  if (take(rest, "Warning:")) return warning_with(rest);
  if (whole.starts_with("RepRapFirmware ") && whole.ends_with("is up and running.")) return reply::Start{};
  if (take(rest, "fatal:")) return reply::Error{std::string(without_blanks(rest)), std::nullopt, true};
  if (whole == "start") return reply::Start{};
  if (whole == "wait") return reply::Wait{};
  if (take(rest, "skip") && ends_word(rest)) return reply::Skip{take_count(rest)};
  rest = whole;
  if (take(rest, "echo:busy:") || take(rest, "busy:"))
    return reply::Busy{rest.find("paused for") != std::string_view::npos};
  if (take(rest, "echo:")) {
    rest = without_blanks(rest);
    return reply::Echo{std::string(rest), rest.starts_with("Unknown command")};
  }
  if (take(rest, "Cap:")) return capability_with(rest, whole);
  if (rest.starts_with("Unknown command")) return reply::Echo{std::string(rest), true};
  if (take(rest, "//action:") || take(rest, "// action:"))
    return reply::Action{std::string(without_blanks(rest))};
  // Repetier's words for the same: its display, a jam, a homing that has failed.
  if (take(rest, "RequestPause:")) return reply::Action{"pause " + std::string(without_blanks(rest))};
  if (take(rest, "RequestContinue:")) return reply::Action{"resume"};
  if (take(rest, "RequestStop:")) return reply::Action{"cancel"};
  if (rest.starts_with("FIRMWARE_NAME:")) return reply::Firmware{std::string(rest)};
  if (rest.starts_with("X:") && !after_label(rest, "Y:").empty()) return position_with(rest);
  if (rest.starts_with("T:") || rest.starts_with("T0:") || rest.starts_with("B:")) {
    if (const Temperatures t = temperatures_in(rest); !t.empty()) {
      return reply::TemperatureReport{t, !after_label(rest, "W:").empty()};
    }
  }
  return reply::Unknown{std::string(whole)};
}

}  // namespace unicursal::gcode
