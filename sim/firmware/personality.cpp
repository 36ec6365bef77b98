#include "sim/firmware/personality.hpp"

#include <array>
#include <stdexcept>

namespace unicursal::sim {

namespace {

constexpr double eight_bit_boot = 1.5;       // s: the boot loader first waits for a new firmware
constexpr double eight_bit_step_rate = 4e4;  // steps/s

Personality marlin() {
  Personality one;
  one.name = "marlin";
  one.chatter = {"start",
                 "PowerUp",
                 "Marlin 2.1.2.1",
                 "",
                 "echo: Simulated printer with a mixing extruder",
                 "echo: Free Memory: 65536  PlannerBufferBytes: 2048",
                 "echo:Hardcoded Default Settings Loaded"};
  return one;
}

Personality marlin_8bit() {
  Personality one = marlin();
  one.name = "marlin-8bit";
  one.mix_scale = 128;
  one.step_rate = eight_bit_step_rate;
  one.boot_seconds = eight_bit_boot;
  one.resets_on_open = true;
  one.chatter.push_back("//action:notification Printer ready");
  return one;
}

Personality marlin_advanced_ok() {
  Personality one = marlin();
  one.name = "marlin-advanced-ok";
  one.advanced_ok = true;
  return one;
}

/// With everything that serves a host.
Personality marlin_host() {
  Personality one = marlin();
  one.name = "marlin-host";
  one.emergency_parser = one.host_prompts = one.homes_first = one.progress = true;
  one.homing_clearance = 4;
  return one;
}

Personality marlin_few_tools() {
  Personality one = marlin();
  one.name = "marlin-few-tools";
  one.virtual_tools = 2;
  return one;
}

/// Built without EXTENDED_CAPABILITIES_REPORT, as boards with little memory are.
Personality marlin_plain() {
  Personality one = marlin_8bit();
  one.name = "marlin-plain";
  one.capabilities = false;
  return one;
}

Personality repetier() {
  Personality one;
  one.name = "repetier";
  one.cold = 150;
  one.family = Personality::Family::repetier;
  one.most_feeders = 6;
  one.direct_mixing = false;
  one.longest_text = 20;
  one.step_rate = eight_bit_step_rate;
  one.boot_seconds = eight_bit_boot;
  one.resets_on_open = true;
  one.chatter = {"start", "Info:PowerUp", "Free RAM:2048", "SelectExtruder:0"};
  return one;
}

Personality repetier_092() {
  Personality one = repetier();
  one.name = "repetier-0.92";
  one.capabilities = false;
  return one;
}

Personality reprapfirmware() {
  Personality one;
  one.name = "reprapfirmware";
  one.family = Personality::Family::reprapfirmware;
  one.direct_mixing = false;
  one.progress = true;
  one.longest_text = 120;
  one.queue_size = 1;
  one.boot_seconds = 4;
  return one;
}

const auto& all_personalities() {
  static const std::array all{marlin(),      marlin_8bit(),      marlin_advanced_ok(),
                              marlin_host(), marlin_few_tools(), marlin_plain(),
                              repetier(),    repetier_092(),     reprapfirmware()};
  return all;
}

}  // namespace

const Personality& personality(std::string_view name) {
  std::string names;
  for (const Personality& one : all_personalities()) {
    if (one.name == name) return one;
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  throw std::invalid_argument("there is no personality \"" + std::string(name) + "\"; the names are " +
                              names);
}

std::vector<std::string> personality_names() {
  std::vector<std::string> names;
  for (const Personality& one : all_personalities()) names.emplace_back(one.name);
  return names;
}

}  // namespace unicursal::sim
