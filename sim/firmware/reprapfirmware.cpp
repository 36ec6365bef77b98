#include "sim/firmware/reprapfirmware.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {

constexpr double coldest_feed = 160, coldest_retraction = 90;  // °C, defaults of M302
constexpr double excursion = 15, fault_seconds = 5;            // °C, s; defaults of M570
constexpr double report_interval = 2;                          // s, UnsolicitedStatusReportInterval
constexpr double warning_interval = 4;                         // s between warnings about extrusion
constexpr double restart_pause = 1;                            // s from M999 to the reset
constexpr std::int32_t whole_share = 1'000'000;                // shares as integers
constexpr double seconds_per_minute = 60;
constexpr int bed_number = 0, nozzle_number = 1, tool_number = 0;
constexpr std::array<char, 3> letters{'X', 'Y', 'Z'};

Machine guarded_as_usual(Machine machine) {
  for (HeaterModel* heater : {&machine.nozzle, &machine.bed_heater}) {
    heater->runaway_margin = excursion;
    heater->runaway_period = fault_seconds;
  }
  machine.limits.least_time = 0;  // short moves are not stretched
  return machine;
}

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string name_of_command(const Command& command) {
  return fmt::format("{}{}", command.letter(), command.code());
}

bool names_an_axis(const Command& command) {
  return std::any_of(letters.begin(), letters.end(), [&](char axis) { return command.has(axis); });
}

/// A board that drives so many extruders: MaxExtruders is 7 on a Duet 2 and 8 on a Duet 3 Mini (Pins_DuetNG.h
/// and Pins_Duet3Mini.h of 3.5.3).
const char* board_for(std::size_t feeders) {
  return feeders <= 7 ? "Duet 2 WiFi/Ethernet" : "Duet 3 Mini 5+";
}

Personality with_its_name(const Personality& personality, std::size_t feeders) {
  Personality named = personality;
  named.chatter = {fmt::format("RepRapFirmware for {} is up and running.", board_for(feeders))};
  return named;
}

/// The numbers of "E.5:.25:.25" in a command's text; empty if the letter is absent.
std::vector<double> list_behind(std::string_view text, char letter) {
  std::vector<double> values;
  const auto at = text.find(letter, 1);
  if (at == std::string_view::npos) return values;
  text.remove_prefix(at + 1);
  for (;;) {
    double value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc() || values.size() == max_feeders + 1) return values;
    values.push_back(std::clamp(value, -largest_number, largest_number));
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.starts_with(':')) return values;
    text.remove_prefix(1);
  }
}

}  // namespace

RepRapFirmware::RepRapFirmware(const Machine& machine, const Personality& personality, MoveSink& sink,
                               Reply reply)
    : Firmware(guarded_as_usual(machine), with_its_name(personality, machine.feeders), sink,
               std::move(reply)) {
  forget();
}

void RepRapFirmware::forget() {
  shares_.assign(machine_.feeders, 0);
  shares_[0] = 1;
  selected_ = tool_fault_ = bed_fault_ = asked_for_heat_ = false;
  absolute_filament_ = true;
  homed_ = {};
  warning_.reset();
}

void RepRapFirmware::die(const std::string& reason) {
  say("Error: " + reason);
  halt();
}

/// Everything stops. It still listens, but refuses nearly every command.
void RepRapFirmware::halt() {
  planner_.abort(now_);
  waits_.clear();
  nozzle_.reset(now_);
  bed_.reset(now_);
  stopped_ = true;
  say_stopped();
}

void RepRapFirmware::say_stopped() {
  say("Emergency Stop! Reset the controller to continue.");
}

// ---- lines

/// A G or M behind other words, but not in a text in quotes, begins another command.
std::vector<std::string> RepRapFirmware::commands_in(const std::string& body) const {
  std::vector<std::string> commands(1);
  bool quoted = false;
  for (const char c : body) {
    const bool begins = !quoted && (c == 'G' || c == 'M' || c == 'g' || c == 'm');
    if (c == '"') quoted = !quoted;
    if (begins && !commands.back().empty()) commands.emplace_back();
    commands.back() += c;
  }
  if (upper(body).starts_with("M117")) return {body};  // its text needs no quotes
  return commands;
}

void RepRapFirmware::refuse(LineVerdict::Kind kind) {
  ++(kind == LineVerdict::Kind::wrong_number ? counts_.number_errors : counts_.checksum_errors);
}

void RepRapFirmware::done(const Line& line) {
  if (!line.more && answers_ok_) say("ok");
}

std::optional<double> RepRapFirmware::next_habit() const {
  std::optional<double> next;
  if (running_ && asked_for_heat_) next = report_due_;
  if (warning_) next = std::min(next.value_or(warning_due_), warning_due_);
  return next;
}

void RepRapFirmware::follow_habits() {
  if (running_ && asked_for_heat_ && now_ >= report_due_) {
    report_due_ = now_ + report_interval;
    say(temperatures());
  }
  if (!warning_ || now_ < warning_due_) return;
  say(*std::exchange(warning_, std::nullopt));
  warning_due_ = now_ + warning_interval;
}

void RepRapFirmware::warn_rarely(std::string text) {
  warning_ = std::move(text);
  if (now_ < warning_due_) return;
  say(*std::exchange(warning_, std::nullopt));
  warning_due_ = now_ + warning_interval;
}

// ---- commands

const std::map<std::pair<char, int>, RepRapFirmware::Own>& RepRapFirmware::own_handlers() {
  using R = RepRapFirmware;
  static const std::map<std::pair<char, int>, Own> table{
      {{'G', 0}, &R::travel},
      {{'G', 1}, &R::travel},
      {{'G', 28}, &R::home_axes},
      {{'G', 90}, &R::axes_mode},
      {{'G', 91}, &R::axes_mode},
      {{'G', 92}, &R::set_place},
      {{'M', 18}, &R::let_go},
      {{'M', 25}, &R::pause_of_file},
      {{'M', 82}, &R::filament_mode},
      {{'M', 83}, &R::filament_mode},
      {{'M', 84}, &R::let_go},
      {{'M', 85}, &R::fan},  // it is accepted, and has no effect
      {{'M', 92}, &R::steps},
      {{'M', 104}, &R::heat_tool},
      {{'M', 105}, &R::tell_temperatures},
      {{'M', 109}, &R::heat_tool_and_wait},
      {{'M', 110}, &R::fan},  // line numbers are not checked
      {{'M', 112}, &R::halt_at_once},
      {{'M', 114}, &R::tell_place},
      {{'M', 115}, &R::tell_name},
      {{'M', 155}, &R::not_supported},
      {{'M', 163}, &R::not_supported},
      {{'M', 164}, &R::not_supported},
      {{'M', 165}, &R::not_supported},
      {{'M', 190}, &R::heat_bed_and_wait},
      {{'M', 201}, &R::accelerations_of_axes},
      {{'M', 203}, &R::speeds},
      {{'M', 205}, &R::jumps},
      {{'M', 221}, &R::flow_factor},
      {{'M', 226}, &R::pause_of_file},
      {{'M', 410}, &R::not_supported},
      {{'M', 562}, &R::clear_faults},
      {{'M', 566}, &R::jumps},
      {{'M', 567}, &R::mix},
      {{'M', 999}, &R::restart},
  };
  return table;
}

void RepRapFirmware::execute(const std::string& body) {
  text_ = upper(body);
  constexpr std::array heard_when_halted{105, 112, 115, 999};
  const auto command = parse_command(text_);
  const bool heard = command && command->letter() == 'M' &&
                     std::find(heard_when_halted.begin(), heard_when_halted.end(), command->code()) !=
                         heard_when_halted.end();
  if (stopped_ && !heard) {
    say(fmt::format("Error: {}: Machine is halted",
                    command ? name_of_command(*command) : text_.substr(0, 1)));
    return;
  }
  if (text_.starts_with('T')) return change_tool(text_);
  if (!command) {
    ++counts_.unknown;
    say("Error: Bad command: " + body);
    return;
  }
  const auto own = own_handlers().find({command->letter(), command->code()});
  if (own != own_handlers().end()) return (this->*own->second)(*command);
  if (handlers().contains({command->letter(), command->code()})) return Firmware::execute(text_);
  not_supported(*command);
}

void RepRapFirmware::not_supported(const Command& command) {
  ++counts_.unknown;
  say(fmt::format("Warning: {}: Command is not supported", name_of_command(command)));
}

void RepRapFirmware::fail(const Command& command, std::string_view why) {
  say(fmt::format("Error: {}: {}", name_of_command(command), why));
}

void RepRapFirmware::travel(const Command& command) {
  moves_axes_ = names_an_axis(command);
  for (std::size_t axis = 0; axis < letters.size(); ++axis) {
    if (!command.has(letters[axis]) || homed_[axis]) continue;
    warn("a move of an axis that is not homed was refused");
    return wait_until_still([this, command] { fail(command, "insufficient axes homed"); });
  }
  move(command);
}

void RepRapFirmware::home_axes(const Command& command) {
  const bool all = !names_an_axis(command);
  for (std::size_t axis = 0; axis < letters.size(); ++axis) {
    if (all || command.has(letters[axis])) homed_[axis] = true;  // nothing else runs until it is
  }
  wait_until_still([this, command] { home(command); });
}

/// A position that is set makes the axis as good as homed.
void RepRapFirmware::set_place(const Command& command) {
  for (std::size_t axis = 0; axis < letters.size(); ++axis) {
    if (command.value(letters[axis])) homed_[axis] = true;
  }
  if (!names_an_axis(command)) return set_origin(command);
  wait_until_still([this, command] { set_origin(command); });
}

/// Leaves the mode of the filament alone.
void RepRapFirmware::axes_mode(const Command& command) {
  absolute(command);
  coordinates_.set_absolute_e(absolute_filament_);
}

void RepRapFirmware::filament_mode(const Command& command) {
  absolute_filament_ = command.code() == 82;
  extruder_mode(command);
}

void RepRapFirmware::let_go(const Command& command) {
  if (command.has('S')) return;
  wait_until_still([this, command] {
    homed_ = {};
    motors_off(command);
  });
}

/// Streaming over USB is not a file that it could pause.
void RepRapFirmware::pause_of_file(const Command& command) {
  if (command.code() == 25) return fail(command, "Cannot pause print, because no file is being printed!");
  fail(command, "use M226 and M601 only within a file being printed");
}

void RepRapFirmware::flow_factor(const Command& command) {
  if (!selected_) return fail(command, "No tool selected");
  flow_percent(command);
}

void RepRapFirmware::halt_at_once(const Command&) {
  halt();
}

void RepRapFirmware::restart(const Command&) {
  answers_ok_ = false;
  wait_seconds(restart_pause, [this] { reset(); });
}

// ---- limits

std::string RepRapFirmware::per_axis(const PerAxis<double>& values, double scale, int decimals) const {
  std::string text;
  for (std::size_t i = 0; i < letters.size(); ++i)
    text += fmt::format("{}: {:.{}f}, ", letters[i], values[i] * scale, decimals);
  text += "E:";
  for (std::size_t drive = 0; drive < machine_.feeders; ++drive)
    text += fmt::format("{}{:.{}f}", drive == 0 ? ' ' : ':', values[axis_e] * scale, decimals);
  return text;
}

void RepRapFirmware::steps(const Command& command) {
  if (names_an_axis(command) || command.has('E')) return steps_per_mm(command);
  say("Steps/mm: " + per_axis(planner_.limits().steps_per_mm, 1, 3));
}

/// mm/min, or mm/s with S1.
void RepRapFirmware::speeds(const Command& command) {
  PerAxis<double>& limits = planner_.limits().max_speed;
  const double unit = command.value_or('S', 0) == 1 ? 1 : seconds_per_minute;
  if (!names_an_axis(command) && !command.has('E'))
    return say(fmt::format("Max speeds ({}): {}, min. speed {:.2f}", unit == 1 ? "mm/sec" : "mm/min",
                           per_axis(limits, unit, 1), 0.5 * unit));
  constexpr double slowest = 0.5;  // mm/s
  constexpr std::array<char, axes> words{'X', 'Y', 'Z', 'E'};
  for (std::size_t i = 0; i < axes; ++i) {
    if (const auto value = command.value(words[i])) limits[i] = std::max(*value / unit, slowest);
  }
}

void RepRapFirmware::accelerations_of_axes(const Command& command) {
  if (names_an_axis(command) || command.has('E')) return accelerations(command);
  say("Accelerations (mm/sec^2): " + per_axis(planner_.limits().max_acceleration, 1, 1));
}

/// M205 in mm/s, M566 in mm/min.
void RepRapFirmware::jumps(const Command& command) {
  const double unit = command.code() == 205 ? 1 : seconds_per_minute;
  PerAxis<double>& limits = planner_.limits().jerk;
  if (!names_an_axis(command) && !command.has('E'))
    return say(fmt::format("Maximum jerk rates ({}): {}", unit == 1 ? "mm/sec" : "mm/min",
                           per_axis(limits, unit, 1)));
  constexpr double least = 0.01;  // mm/s
  constexpr std::array<char, axes> words{'X', 'Y', 'Z', 'E'};
  for (std::size_t i = 0; i < axes; ++i) {
    if (const auto value = command.value(words[i])) limits[i] = std::max(*value / unit, least);
  }
}

// ---- the tool

bool RepRapFirmware::addresses_tool(const Command& command, char letter) {
  if (command.value_or(letter, tool_number) == tool_number) return true;
  fail(command, "Invalid tool number");
  return false;
}

/// T0, T-1, T0 P0. All motion ends before the tool changes; a number without a tool leaves none.
void RepRapFirmware::change_tool(const std::string& text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  if (std::from_chars(text.data() + 1, end, number).ec != std::errc())
    return say(selected_ ? fmt::format("Tool {} is selected", tool_number) : "No tool is selected");
  wait_until_still([this, number] { selected_ = number == tool_number; });
}

/// Acts on the moves that are read after it, and waits for nothing.
void RepRapFirmware::mix(const Command& command) {
  if (!command.has('P') && !selected_) return fail(command, "No tool number given and no current tool");
  if (!addresses_tool(command, 'P')) return;
  if (!command.has('E')) {
    std::string list;
    for (const double share : shares_) list += fmt::format("{}{:.3f}", list.empty() ? ' ' : ':', share);
    return say(fmt::format("Tool {} mix ratios:{}", tool_number, list));
  }
  const std::vector<double> shares = list_behind(text_, 'E');
  if (shares.size() != shares_.size()) return say("Setting mix ratios - wrong number of E drives: " + text_);
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (std::abs(sum - 1) > 1e-3) warn("the shares of a mixture did not add up to one");
  shares_ = shares;
}

Mix RepRapFirmware::current_mix() const {
  Mix mix;
  mix.tool = tool_number;
  const double largest = *std::max_element(shares_.begin(), shares_.end());
  mix.factors[0] = largest > 0 ? 0 : whole_share;
  for (std::size_t i = 0; i < shares_.size() && largest > 0; ++i)
    mix.factors[i] =
        static_cast<std::int32_t>(std::lround(std::max(shares_[i], 0.0) / largest * whole_share));
  return mix;
}

/// Each drive feeds E times its share; M221 scales moves of the axes only. A tool that is cold or has a
/// heater fault is not driven, and the axes move without it.
double RepRapFirmware::filament_to_feed(double e) {
  if (e == 0) return 0;
  if (!selected_) {
    warn("extrusion without a tool");
    warn_rarely("Error: Attempting to extrude with no tool selected.");
    return 0;
  }
  if (tool_fault_ || nozzle_.temperature(now_) < (e > 0 ? coldest_feed : coldest_retraction)) {
    warn("cold extrusion prevented");
    warn_rarely(
        fmt::format("Warning: Tool {} was not driven because its heater temperatures were not high enough "
                    "or it has a heater fault",
                    tool_number));
    return 0;
  }
  const double sum = std::accumulate(shares_.begin(), shares_.end(), 0.0);
  return e * sum * (moves_axes_ ? coordinates_.flow() : 1);
}

// ---- heat

void RepRapFirmware::set_nozzle(double target) {
  if (!tool_fault_) nozzle_.set_target(now_, target);
}

void RepRapFirmware::heat_tool(const Command& command) {
  const auto target = command.value(command.has('R') ? 'R' : 'S');
  if (target && addresses_tool(command, 'T')) set_nozzle(*target);
}

/// Selects the tool if none is in use. A heater that has failed is not waited for.
void RepRapFirmware::heat_tool_and_wait(const Command& command) {
  wait_until_still([this, command] {
    const bool both = command.has('R');
    const auto target = command.value(both ? 'R' : 'S');
    if (!target || !addresses_tool(command, 'T')) return;
    selected_ = true;
    set_nozzle(*target);
    if (nozzle_.target() > 0) wait_for_heater(nozzle_, !both);
  });
}

void RepRapFirmware::heat_bed_and_wait(const Command& command) {
  wait_until_still([this, command] {
    const bool both = command.has('R');
    const auto target = command.value(both ? 'R' : 'S');
    if (!target || bed_fault_) return;
    bed_.set_target(now_, *target);
    if (*target > 0) wait_for_heater(bed_, !both);
  });
}

/// The heater is switched off until M562; everything else goes on.
void RepRapFirmware::alarm(Heater::Alarm what, bool of_bed) {
  Heater& heater = of_bed ? bed_ : nozzle_;
  const double target = heater.target(), reading = heater.temperature(now_);
  heater.reset(now_);
  if (std::exchange(of_bed ? bed_fault_ : tool_fault_, true)) return;
  const auto why = [&]() -> std::string {
    switch (what) {
      case Heater::Alarm::heating_failed:
        return "temperature rising too slowly: expected 1.00°C/sec measured 0.00°C/sec";
      case Heater::Alarm::thermal_runaway:
        return fmt::format("exceeded allowed temperature excursion: target {:.1f}°C actual {:.1f}°C", target,
                           reading);
      case Heater::Alarm::min_temp:
        return "failed to read sensor: sensor open circuit";
      case Heater::Alarm::max_temp:
        break;
    }
    return "monitor 0 was triggered";
  };
  say(fmt::format("Error: Heater {} fault: {}", of_bed ? bed_number : nozzle_number, why()));
  if (!waits_for_heat() || waits_.front().heat->heater != &heater) return;
  waits_.pop_front();  // nothing to wait for
}

void RepRapFirmware::clear_faults(const Command&) {
  tool_fault_ = bed_fault_ = false;
}

std::string RepRapFirmware::temperatures() const {
  const std::string nozzle = fmt::format("{:.1f} /{:.1f}", nozzle_.temperature(now_), nozzle_.target());
  return fmt::format("{}T{}:{} B:{:.1f} /{:.1f}", selected_ ? "T:" + nozzle + " " : "", tool_number, nozzle,
                     bed_.temperature(now_), bed_.target());
}

void RepRapFirmware::tell_temperatures(const Command&) {
  asked_for_heat_ = true;
  report_due_ = now_ + report_interval;
  answers_ok_ = false;
  say("ok " + temperatures());
}

// ---- the rest

void RepRapFirmware::tell_place(const Command&) {
  const auto& place = coordinates_.place();
  const auto& at = planner_.executed_position();
  std::string text =
      fmt::format("X:{:.3f} Y:{:.3f} Z:{:.3f} E:{:.3f}", coordinates_.logical(axis_x),
                  coordinates_.logical(axis_y), coordinates_.logical(axis_z), coordinates_.e());
  const double per_mm = planner_.limits().steps_per_mm[axis_e];
  for (std::size_t drive = 0; drive < machine_.feeders; ++drive)
    text += fmt::format(" E{}:{:.1f}", drive, static_cast<double>(planner_.feeder_steps()[drive]) / per_mm);
  say(fmt::format("{} Count {} {} {} Machine {:.3f} {:.3f} {:.3f} Bed comp 0.000", text,
                  at[axis_x] - origin_[axis_x], at[axis_y] - origin_[axis_y], at[axis_z] - origin_[axis_z],
                  place[0], place[1], place[2]));
}

void RepRapFirmware::tell_name(const Command&) {
  say(
      fmt::format("FIRMWARE_NAME: RepRapFirmware for {} FIRMWARE_VERSION: 3.5.3 ELECTRONICS: simulated "
                  "FIRMWARE_DATE: 2024-09-18",
                  board_for(machine_.feeders)));
}

}  // namespace unicursal::sim
