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
    Phrase{M::stopped, "emergency stop! reset the controller", "",
           "Emergency Stop! Reset the controller to continue.",
           "RepRapFirmware 2 and 3, DoEmergencyStop() in GCodes.cpp"},
    Phrase{M::stopped, "", ": machine is halted", "Error: G1: Machine is halted",
           "RepRapFirmware 3, HandleResult() in GCodes2.cpp, at every command until M999"},
    Phrase{M::refuses_to_move, "", "insufficient axes homed", "Error: G1: insufficient axes homed",
           "RepRapFirmware 2 and 3, DoStraightMove() in GCodes.cpp; with \"G0/G1\" before 3.4"},
    Phrase{M::too_cold, "tool ", "was not driven because its heater temperatures were not high enough",
           "Warning: Tool 0 was not driven because its heater temperatures were not high enough or it has a "
           "heater fault",
           "RepRapFirmware 2 and 3, Tool.cpp; the axes move on without it"},
    Phrase{M::too_cold, "heater ", " fault: ",
           "Error: Heater 1 fault: exceeded allowed temperature excursion: target 210.0C actual 180.0C",
           "RepRapFirmware 3.4 and later, Event.cpp; the heater stays off until M562"},
    Phrase{M::too_cold, "heating fault on heater ", "",
           "Error: Heating fault on heater 1, temperature excursion exceeded 15.0C",
           "RepRapFirmware 2 to 3.3, Pid.cpp and LocalHeater.cpp"},
    Phrase{M::no_such_tool, "attempting to extrude with no tool selected", "",
           "Error: Attempting to extrude with no tool selected.", "RepRapFirmware 2 and 3, GCodes.cpp"},
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
  for (const std::string_view prefix : {"error:", "warning:", "echo:", "!!"}) {
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
