// The commands. A handler acts at once, or adds the conditions that the command waits for; the ok follows
// when no wait is left.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

namespace {

constexpr double longest_extrusion = 200;                           // mm of E in one move
constexpr double homing_speed = 50, homing_speed_z = 4;             // mm/s
constexpr double homing_way_back = 10, homing_touch_seconds = 1.5;  // least way, mm; second touch, s
constexpr double longest_report_interval = 60;                      // s
constexpr double longest_dwell = 4294967.295;  // s: the firmware's clock counts 32 bits of ms
constexpr double least_steps_per_mm = 0.1, most_steps_per_mm = 1e5;
constexpr double least_speed = 0.05, least_acceleration = 1, least_jerk = 0.01;  // mm/s, mm/s², mm/s

constexpr auto stopped_sentence =
    "Printer stopped due to errors. Fix the error and use M999 to restart. (Temperature is reset. Set it "
    "after restarting)";

/// Of M165. Marlin has no letters for more feeders, and is then built without the command
/// (DIRECT_MIXING_IN_G1).
constexpr std::string_view direct_letters = "ABCDHI";

constexpr std::array<char, axes> axis_letters{'X', 'Y', 'Z', 'E'};

/// Takes the number of a word, if it has one, but at least `least`.
void read(const Command& command, char letter, double least, double& value) {
  if (const auto given = command.value(letter)) value = std::max(*given, least);
}

void read_axes(const Command& command, double least, PerAxis<double>& values) {
  for (std::size_t i = 0; i < axes; ++i) read(command, axis_letters[i], least, values[i]);
}

std::int64_t to_steps(double mm, double steps_per_mm) {
  return std::llround(mm * steps_per_mm);
}

}  // namespace

const std::map<std::pair<char, int>, Firmware::Handler>& Firmware::handlers() {
  using F = Firmware;
  static const std::map<std::pair<char, int>, Handler> table{
      {{'G', 0}, &F::move},
      {{'G', 1}, &F::move},
      {{'G', 2}, &F::arc},
      {{'G', 3}, &F::arc},
      {{'G', 4}, &F::dwell},
      {{'G', 20}, &F::inches},
      {{'G', 21}, &F::inches},
      {{'G', 28}, &F::home},
      {{'G', 90}, &F::absolute},
      {{'G', 91}, &F::absolute},
      {{'G', 92}, &F::set_origin},
      {{'M', 0}, &F::stop_for_person},
      {{'M', 1}, &F::stop_for_person},
      {{'M', 17}, &F::nothing},
      {{'M', 18}, &F::motors_off},
      {{'M', 31}, &F::print_time},
      {{'M', 73}, &F::set_progress},
      {{'M', 75}, &F::nothing},
      {{'M', 76}, &F::nothing},
      {{'M', 77}, &F::nothing},
      {{'M', 82}, &F::extruder_mode},
      {{'M', 83}, &F::extruder_mode},
      {{'M', 84}, &F::motors_off},
      {{'M', 85}, &F::set_inactivity},
      {{'M', 92}, &F::steps_per_mm},
      {{'M', 104}, &F::nozzle_target},
      {{'M', 105}, &F::report_temperatures},
      {{'M', 106}, &F::fan},
      {{'M', 107}, &F::fan},
      {{'M', 108}, &F::nothing},
      {{'M', 109}, &F::wait_nozzle},
      {{'M', 110}, &F::line_number},
      {{'M', 112}, &F::emergency_stop},
      {{'M', 113}, &F::keepalive},
      {{'M', 114}, &F::report_position},
      {{'M', 115}, &F::report_firmware},
      {{'M', 117}, &F::show_text},
      {{'M', 118}, &F::echo_text},
      {{'M', 119}, &F::endstops},
      {{'M', 140}, &F::bed_target},
      {{'M', 155}, &F::auto_report},
      {{'M', 163}, &F::collect_share},
      {{'M', 164}, &F::store_mixture},
      {{'M', 165}, &F::mix_directly},
      {{'M', 190}, &F::wait_bed},
      {{'M', 201}, &F::accelerations},
      {{'M', 203}, &F::max_speeds},
      {{'M', 204}, &F::set_accelerations},
      {{'M', 205}, &F::jerks},
      {{'M', 211}, &F::soft_endstops},
      {{'M', 220}, &F::feed_percent},
      {{'M', 221}, &F::flow_percent},
      {{'M', 301}, &F::pid},
      {{'M', 302}, &F::cold_extrusion},
      {{'M', 400}, &F::finish_moves},
      {{'M', 410}, &F::stop_moves},
      {{'M', 412}, &F::runout_sensor},
      {{'M', 500}, &F::store_settings},
      {{'M', 501}, &F::load_settings},
      {{'M', 502}, &F::load_settings},
      {{'M', 503}, &F::report_settings},
      {{'M', 600}, &F::change_filament},
      {{'M', 876}, &F::nothing},
      {{'M', 999}, &F::go_on},
  };
  return table;
}

void Firmware::execute(const std::string& body) {
  const auto command = parse_command(body);
  if (command && command->letter() == 'T') return select_tool(*command);
  if (command && knows(*command)) {
    const auto found = handlers().find({command->letter(), command->code()});
    if (found != handlers().end()) return (this->*found->second)(*command);
  }
  ++counts_.unknown;
  say_unknown(body);
}

bool Firmware::handles(const Command& command) const {
  return command.letter() == 'T' ||
         (knows(command) && handlers().contains({command.letter(), command.code()}));
}

void Firmware::say_unknown(const std::string& body) {
  say(fmt::format("echo:Unknown command: \"{}\"", body));
}

bool Firmware::knows(const Command& command) const {
  if (command.is('M', 155) && !personality_.capabilities) return false;
  if (command.is('M', 73) && !personality_.progress) return false;
  return (personality_.direct_mixing && machine_.feeders <= direct_letters.size()) || !command.is('M', 165);
}

// ---- moves

void Firmware::move(const Command& command) {
  if (stopped_) {
    warn("a move was refused, since the firmware had stopped itself");
    return say_still_stopped();
  }
  if (personality_.homes_first && refused_unhomed(command)) return;
  const MoveTarget target = coordinates_.target(command);
  if (target.held_at_edge) warn("a move beyond the bed was held at its edge");
  const double before = coordinates_.e();
  coordinates_.arrive(target);
  if (planner_.has_room()) return plan(target, target.e - before);
  wait_for_room([this, target, before] { plan(target, target.e - before); });
}

/// NO_MOTION_BEFORE_HOMING: the whole move is left out.
bool Firmware::refused_unhomed(const Command& command) {
  std::string missing;
  constexpr std::array<Axis, 3> all{axis_x, axis_y, axis_z};
  for (const Axis axis : all) {
    if (command.has(axis_letters[axis]) && !coordinates_.homed(axis)) missing += axis_letters[axis];
  }
  if (missing.empty()) return false;
  warn("a move was refused, since an axis had not been homed");
  say(fmt::format("echo:Home {} First", missing));
  return true;
}

/// G2 and G3 in the plane of the bed, by centre (I J) or radius (R), as chords of about 1 mm
/// (MM_PER_ARC_SEGMENT). Without a centre Marlin reports an error.
void Firmware::arc(const Command& command) {
  const MoveTarget end = coordinates_.target(command);
  const std::array<double, 3> from = coordinates_.place();
  const double way_x = end.place[0] - from[0], way_y = end.place[1] - from[1];
  const double side = command.code() == 2 ? -1 : 1;
  double to_x = command.value_or('I', 0), to_y = command.value_or('J', 0);
  if (const auto radius = command.value('R')) {
    const double half = std::hypot(way_x, way_y) / 2;
    const double height = std::sqrt(std::max(*radius * *radius - half * half, 0.0));
    const double turn = side * (*radius > 0 ? 1 : -1) * height / std::max(2 * half, 1e-9);
    to_x = way_x / 2 - turn * way_y;
    to_y = way_y / 2 + turn * way_x;
  }
  const double radius = std::hypot(to_x, to_y);
  if (stopped_ || radius < 1e-6) return say("Error:G2/G3 bad parameters");
  const double begin = std::atan2(-to_y, -to_x);
  double sweep = std::atan2(way_y - to_y, way_x - to_x) - begin;
  constexpr double whole = 2 * 3.14159265358979323846;
  while (side * sweep <= 1e-9) sweep += side * whole;
  while (side * sweep > whole + 1e-9) sweep -= side * whole;
  const double pieces = std::clamp(std::floor(radius * std::abs(sweep)), 1.0, 10000.0);
  const double e = coordinates_.e();
  std::vector<MoveTarget> targets;
  for (double i = 1; i < pieces; ++i) {
    const double share = i / pieces, angle = begin + share * sweep;
    MoveTarget target = end;
    target.place = {from[0] + to_x + radius * std::cos(angle), from[1] + to_y + radius * std::sin(angle),
                    from[2] + share * (end.place[2] - from[2])};
    target.e = e + share * (end.e - e);
    targets.push_back(target);
  }
  targets.push_back(end);
  run_arc(std::move(targets));
}

void Firmware::run_arc(std::vector<MoveTarget> pieces) {
  for (const MoveTarget& piece : pieces) {
    const double before = coordinates_.e();
    coordinates_.arrive(piece);
    wait_for_room([this, piece, before] { plan(piece, piece.e - before); });
  }
}

void Firmware::plan(const MoveTarget& target, double e) {
  const double fed = filament_to_feed(e);
  filament_ += fed;
  const PerAxis<double> mm{target.place[0], target.place[1], target.place[2], filament_};
  PerAxis<std::int64_t> steps{};
  for (std::size_t i = 0; i < axes; ++i) {
    steps[i] = origin_[i] + to_steps(mm[i], planner_.limits().steps_per_mm[i]);
  }
  planner_.push({steps, fed, target.speed, current_mix()}, now_);
}

/// Returns the part of a move's E that is really fed: all, or 0 if extrusion is refused; x and y move anyway.
double Firmware::filament_to_feed(double e) {
  if (e == 0) return 0;
  if (nozzle_.temperature(now_) < cold_) {
    warn("cold extrusion prevented");
    say_refused("cold extrusion prevented");
    return 0;
  }
  if (std::abs(e * coordinates_.flow()) > longest_extrusion) {
    warn("too long extrusion prevented");
    say_refused("too long extrusion prevented");
    return 0;
  }
  return e * coordinates_.flow();
}

void Firmware::say_refused(const char* what) {
  say(fmt::format("echo: {}", what));
}

void Firmware::say_stopped() {
  say(fmt::format("Error:{}", stopped_sentence));
}

void Firmware::say_still_stopped() {
  say(stopped_sentence);
}

void Firmware::dwell(const Command& command) {
  const double seconds = std::max(0.0, command.value_or('P', 0) / 1000 + command.value_or('S', 0));
  wait_until_still([this, seconds] { wait_seconds(std::min(seconds, longest_dwell), nullptr); });
}

void Firmware::home(const Command& command) {
  const bool all = !command.has('X') && !command.has('Y') && !command.has('Z');
  const bool x = all || command.has('X'), y = all || command.has('Y'), z = all || command.has('Z');
  wait_until_still([this, x, y, z] {
    const auto way = [this](Axis axis) { return std::max(coordinates_.place()[axis], homing_way_back); };
    double seconds = 0;
    if (x || y)
      seconds += std::max(x ? way(axis_x) : 0, y ? way(axis_y) : 0) / homing_speed + homing_touch_seconds;
    if (z) seconds += way(axis_z) / homing_speed_z + homing_touch_seconds;
    if (!z) lift_for_homing();
    wait_seconds(seconds, [this, x, y, z] { homed(x, y, z); });
  });
}

/// Marlin's Z_CLEARANCE_FOR_HOMING: z is only ever raised, and stays where it is then.
void Firmware::lift_for_homing() {
  const double rise = personality_.homing_clearance - coordinates_.place()[axis_z];
  if (rise <= 0) return;
  coordinates_.raise(rise);
  PerAxis<std::int64_t> steps = planner_.planned_position();
  steps[axis_z] += to_steps(rise, planner_.limits().steps_per_mm[axis_z]);
  planner_.set_position(steps);
}

void Firmware::homed(bool x, bool y, bool z) {
  PerAxis<std::int64_t> steps = planner_.planned_position();
  const std::array<bool, 3> chosen{x, y, z};
  for (const Axis axis : {axis_x, axis_y, axis_z}) {
    if (!chosen[axis]) continue;
    coordinates_.home(axis);
    steps[axis] = origin_[axis] = 0;
  }
  planner_.set_position(steps);
  say_position();
}

void Firmware::finish_moves(const Command&) {
  wait_until_still(nullptr);
}

void Firmware::stop_moves(const Command&) {
  quick_stop();
}

void Firmware::motors_off(const Command& command) {
  if (command.has('S')) return;  // only a timeout, which the simulator does not need
  wait_until_still([this] { coordinates_.forget_home(); });
}

// ---- modes and limits

void Firmware::inches(const Command& command) {
  coordinates_.set_inches(command.code() == 20);
}
void Firmware::absolute(const Command& command) {
  coordinates_.set_absolute(command.code() == 90);
}
void Firmware::extruder_mode(const Command& command) {
  coordinates_.set_absolute_e(command.code() == 82);
}
void Firmware::set_origin(const Command& command) {
  coordinates_.shift_origin(command);
  if (personality_.family == Personality::Family::marlin) say_position();
}
void Firmware::feed_percent(const Command& command) {
  if (const auto percent = command.value('S')) return coordinates_.set_feed_percent(*percent);
  say(fmt::format("FR:{:.0f}%", 100 * coordinates_.feed()));
}
void Firmware::flow_percent(const Command& command) {
  if (const auto percent = command.value('S')) return coordinates_.set_flow_percent(*percent);
  say(fmt::format("echo:E0 Flow: {:.0f}%", 100 * coordinates_.flow()));
}
void Firmware::accelerations(const Command& command) {
  if (only_asks(command)) return;
  read_axes(command, least_acceleration, planner_.limits().max_acceleration);
}
void Firmware::max_speeds(const Command& command) {
  if (only_asks(command)) return;
  read_axes(command, least_speed, planner_.limits().max_speed);
}
void Firmware::jerks(const Command& command) {
  if (only_asks(command)) return;
  read_axes(command, least_jerk, planner_.limits().jerk);
}

void Firmware::set_accelerations(const Command& command) {
  if (only_asks(command)) return;
  MotionLimits& limits = planner_.limits();
  read(command, 'S', least_acceleration, limits.print_acceleration);
  read(command, 'S', least_acceleration, limits.travel_acceleration);
  read(command, 'P', least_acceleration, limits.print_acceleration);
  read(command, 'R', least_acceleration, limits.retract_acceleration);
  read(command, 'T', least_acceleration, limits.travel_acceleration);
}

/// Waits for motion to end (Marlin does not), so that no queued block changes its meaning.
void Firmware::steps_per_mm(const Command& command) {
  if (only_asks(command)) return;
  wait_until_still([this, command] {
    PerAxis<double>& ratios = planner_.limits().steps_per_mm;
    const PerAxis<double> before = ratios;
    read_axes(command, least_steps_per_mm, ratios);
    PerAxis<std::int64_t> steps = planner_.planned_position();
    for (std::size_t i = 0; i < axes; ++i) {
      ratios[i] = std::min(ratios[i], most_steps_per_mm);
      steps[i] = to_steps(static_cast<double>(steps[i]) / before[i], ratios[i]);
      origin_[i] = to_steps(static_cast<double>(origin_[i]) / before[i], ratios[i]);
    }
    planner_.set_position(steps);
  });
}

// ---- tools and mixtures

void Firmware::collect_share(const Command& command) {
  if (command.value_or('S', 0) < 0) warn("M163 with a negative S would write outside the firmware's memory");
  mixer_.collect(command.value_or('S', 0), command.value_or('P', 0));
}

void Firmware::store_mixture(const Command& command) {
  if (const auto tool = command.value('S')) {
    mixer_.store(*tool);
  } else {
    mixer_.store();
  }
}

/// M165 A… B… C…: fills the collector and stores it into the current tool; an omitted letter means 0, but
/// without any letter nothing changes.
void Firmware::mix_directly(const Command& command) {
  const std::string_view letters = direct_letters.substr(0, machine_.feeders);
  if (std::none_of(letters.begin(), letters.end(), [&](char letter) { return command.has(letter); })) return;
  for (std::size_t i = 0; i < letters.size(); ++i)
    mixer_.collect(static_cast<double>(i), command.value_or(letters[i], 0));
  mixer_.store();
}

void Firmware::select_tool(const Command& command) {
  if (!mixer_.select(command.code())) reply_(fmt::format("echo:T{} Invalid extruder", command.code()));
}

// ---- heat

std::string Firmware::temperatures() const {
  return fmt::format("T:{:.2f} /{:.2f} B:{:.2f} /{:.2f} @:{} B@:{}", nozzle_.temperature(now_),
                     nozzle_.target(), bed_.temperature(now_), bed_.target(), nozzle_.power(), bed_.power());
}

/// Only T0 has a heater; the virtual tools share it.
bool Firmware::extruder_exists(const Command& command) {
  const double extruder = command.value_or('T', 0);
  if (extruder == 0) return true;
  say(fmt::format("echo:M{} Invalid extruder {:.0f}", command.code(), extruder));
  return false;
}

void Firmware::nozzle_target(const Command& command) {
  if (!extruder_exists(command)) return;
  if (const auto target = command.value('S')) nozzle_.set_target(now_, *target);
}

void Firmware::wait_nozzle(const Command& command) {
  if (!extruder_exists(command)) return;
  const bool both = command.has('R');
  if (const auto target = command.value(both ? 'R' : 'S')) nozzle_.set_target(now_, *target);
  wait_for_heater(nozzle_, !both);
}

void Firmware::bed_target(const Command& command) {
  if (const auto target = command.value('S')) bed_.set_target(now_, *target);
}

void Firmware::wait_bed(const Command& command) {
  const bool both = command.has('R');
  if (const auto target = command.value(both ? 'R' : 'S')) bed_.set_target(now_, *target);
  wait_for_heater(bed_, !both);
}

/// The ok is part of the report's own line; a wrong extruder gets no ok at all.
void Firmware::report_temperatures(const Command& command) {
  answers_ok_ = false;
  if (extruder_exists(command)) reply_("ok " + temperatures());
}

void Firmware::auto_report(const Command& command) {
  report_interval_ = std::clamp(command.value_or('S', 0), 0.0, longest_report_interval);
  report_at_ = now_ + report_interval_;
}

// ---- the rest

void Firmware::line_number(const Command& command) {
  if (const auto number = command.value('N')) check_.set_last(static_cast<std::int64_t>(*number));
}

void Firmware::emergency_stop(const Command&) {
  say("echo:M112 Shutdown");
  kill();
}

void Firmware::set_inactivity(const Command& command) {
  inactivity_ = std::max(0.0, command.value_or('S', 0));
}

/// It waits for all moves to end.
void Firmware::report_position(const Command&) {
  wait_until_still([this] { say_position(); });
}

/// It also throws away what it has received and not read, and asks for it again.
void Firmware::go_on(const Command&) {
  stopped_ = false;
  buffer_.flush();
  say(fmt::format("Resend: {}", check_.last() + 1));
  say("ok");
}

void Firmware::say_position() {
  const auto& steps = planner_.executed_position();
  say(fmt::format("X:{:.2f} Y:{:.2f} Z:{:.2f} E:{:.2f} Count X:{} Y:{} Z:{}", coordinates_.logical(axis_x),
                  coordinates_.logical(axis_y), coordinates_.logical(axis_z), coordinates_.e(),
                  steps[axis_x] - origin_[axis_x], steps[axis_y] - origin_[axis_y],
                  steps[axis_z] - origin_[axis_z]));
}

void Firmware::report_firmware(const Command&) {
  say("FIRMWARE_NAME:Marlin 2.1.2 (simulated) SOURCE_CODE_URL:none PROTOCOL_VERSION:1.0 "
      "MACHINE_TYPE:unicursal simulator EXTRUDER_COUNT:1 UUID:00000000-0000-0000-0000-000000000000");
  if (!personality_.capabilities) return;
  // As a stock Marlin 2.1.2 lists them. BUSY_PROTOCOL is not among them.
  std::vector<std::string_view> can{"AUTOREPORT_TEMP", "PRINT_JOB", "THERMAL_PROTECTION", "ARCS"};
  if (personality_.emergency_parser) can.emplace_back("EMERGENCY_PARSER");
  if (personality_.progress) can.emplace_back("BUILD_PERCENT");
  if (personality_.host_prompts) can.insert(can.end(), {"HOST_ACTION_COMMANDS", "PROMPT_SUPPORT"});
  for (const char* name : {"SERIAL_XON_XOFF",
                           "BINARY_FILE_TRANSFER",
                           "EEPROM",
                           "VOLUMETRIC",
                           "AUTOREPORT_POS",
                           "AUTOREPORT_TEMP",
                           "PROGRESS",
                           "PRINT_JOB",
                           "AUTOLEVEL",
                           "RUNOUT",
                           "Z_PROBE",
                           "LEVELING_DATA",
                           "BUILD_PERCENT",
                           "SOFTWARE_POWER",
                           "TOGGLE_LIGHTS",
                           "CASE_LIGHT_BRIGHTNESS",
                           "EMERGENCY_PARSER",
                           "HOST_ACTION_COMMANDS",
                           "PROMPT_SUPPORT",
                           "SDCARD",
                           "REPEAT",
                           "SD_WRITE",
                           "AUTOREPORT_SD_STATUS",
                           "LONG_FILENAME",
                           "LFN_WRITE",
                           "CUSTOM_FIRMWARE_UPLOAD",
                           "EXTENDED_M20",
                           "THERMAL_PROTECTION",
                           "MOTION_MODES",
                           "ARCS",
                           "BABYSTEPPING",
                           "CHAMBER_TEMPERATURE",
                           "COOLER_TEMPERATURE",
                           "MEATPACK",
                           "CONFIG_EXPORT"}) {
    const bool on = std::find(can.begin(), can.end(), std::string_view(name)) != can.end();
    say(fmt::format("Cap:{}:{}", name, on ? 1 : 0));
  }
}

}  // namespace unicursal::sim
