#include "firmware_gcode/reply/phrases.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace unicursal::gcode {
namespace {

using M = Meaning;

constexpr std::array all{
    Phrase{
        M::stopped, "printer stopped due to errors", "",
        "Error:Printer stopped due to errors. Fix the error and use M999 to restart. (Temperature is reset. "
        "Set it after restarting)",
        "Marlin 1.1 to 2.1 and Prusa's fork, STR_ERR_STOPPED; without \"Error:\" at every move after it"},
    Phrase{M::stopped, "printer halted", "", "Error:Printer halted. kill() called!",
           "Marlin 1.1 to 2.1, STR_ERR_KILLED"},
    Phrase{M::stopped, "", "kill caused by",
           "Error:!! KILL caused by too much inactive time - current command: ",
           "Marlin 1.1 to 2.1, STR_KILL_INACTIVE_TIME and STR_KILL_BUTTON"},
    Phrase{M::stopped, "", "mintemp triggered", "Error:MINTEMP triggered, system stopped! Heater_ID: 0",
           "Marlin 1.1 to 2.1, STR_T_MINTEMP"},
    Phrase{M::stopped, "", "maxtemp triggered", "Error:0: Extruder switched off. MAXTEMP triggered !",
           "Marlin 1.0 and Prusa's fork; Marlin 1.1 to 2.1, STR_T_MAXTEMP"},
    Phrase{M::stopped, "", ", system stopped! heater_id:",
           "Error:Heating failed, system stopped! Heater_ID: bed", "Marlin 1.1 to 2.1, STR_STOPPED_HEATER"},
    Phrase{M::stopped, "one heater seems decoupled", "",
           "Error:One heater seems decoupled from thermistor - disabling all for safety!",
           "Repetier 0.91 to 1.0, tHeaterDecoupledWarning"},
    Phrase{M::stopped, "printer set into dry run mode", "",
           "Error:Printer set into dry run mode until restart!",
           "Repetier 0.9 to 1.0, tDryModeUntilRestart; without \"Error:\" in old versions"},
    Phrase{M::stopped, "stop called because of", "",
           "Error:!! STOP called because of BLTouch error - restart with M999",
           "Marlin 2.0 and 2.1, STR_STOP_BLTOUCH and STR_STOP_UNHOMED; without \"!!\" in 1.1"},
    Phrase{M::refuses_to_move, "home ", "first", "echo:Home XYZ First",
           "Marlin 1.1 to 2.1, NO_MOTION_BEFORE_HOMING"},
    Phrase{M::too_cold, "", "cold extrusion prevented", "echo: cold extrusion prevented",
           "Marlin 1.1 to 2.1, STR_ERR_COLD_EXTRUDE_STOP; with \"Error:\" in some versions of 2.0"},
    Phrase{M::too_long, "", "too long extrusion prevented", "echo: too long extrusion prevented",
           "Marlin 1.1 to 2.1, STR_ERR_LONG_EXTRUDE_STOP"},
    Phrase{M::no_such_tool, "t", " invalid extruder", "echo:T2 Invalid extruder",
           "Marlin 1.1 to 2.1, STR_INVALID_EXTRUDER after a T command"}};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string_view without_prefix(std::string_view text) {
  const auto skip_spaces = [&] { text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size())); };
  skip_spaces();
  for (const std::string_view prefix : {"error:", "echo:", "!!"}) {
    if (!text.starts_with(prefix)) continue;
    text.remove_prefix(prefix.size());
    skip_spaces();
  }
  return text;
}

}  // namespace

std::span<const Phrase> phrases() {
  return all;
}

std::optional<Meaning> meaning_of(std::string_view line) {
  const std::string whole = lower(line);
  const std::string_view sentence = without_prefix(whole);
  if (sentence.starts_with("//")) return std::nullopt;
  for (const Phrase& phrase : all) {
    if (sentence.starts_with(phrase.begins) &&
        sentence.substr(phrase.begins.size()).find(phrase.contains) != std::string_view::npos)
      return phrase.meaning;
  }
  return std::nullopt;
}

}  // namespace unicursal::gcode
