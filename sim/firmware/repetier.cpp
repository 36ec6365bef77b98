#include "sim/firmware/repetier.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sim/firmware/reprapfirmware.hpp"

namespace unicursal::sim {

namespace {
constexpr double ask_interval = 0.2;      // s between requests for the same line
constexpr double idle_interval = 1;       // s without a command after which it says "wait"
constexpr std::int32_t heaviest = 30000;  // weights are 16-bit integers

/// The length of a binary packet by its first bytes, four or more. Two of them are a set of bits that says
/// which words follow; from version 2 on two more. Two bytes of checksum end it (Repetier's host protocol).
std::size_t packet_length(std::string_view bytes) {
  const auto word = [&](std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) |
           static_cast<unsigned>(static_cast<unsigned char>(bytes[at + 1])) << 8U;
  };
  struct Part {
    unsigned bit;
    std::size_t length;
  };
  // N, X, Y, Z, E, F, T, S, P
  constexpr std::array<Part, 9> parts{
      {{0, 2}, {3, 4}, {4, 4}, {5, 4}, {6, 4}, {8, 4}, {9, 1}, {10, 4}, {11, 4}}};
  const unsigned bits = word(0);
  const auto has = [](unsigned set, unsigned bit) { return (set >> bit & 1U) != 0; };
  std::size_t length = 4;
  for (const Part& part : parts) length += has(bits, part.bit) ? part.length : 0;
  const bool second_version = has(bits, 12);
  const std::size_t code = second_version ? 2 : 1;
  if (has(bits, 1)) length += code;  // M
  if (has(bits, 2)) length += code;  // G
  if (!second_version) return length + (has(bits, 15) ? 16 : 0);
  const unsigned more = word(2);
  length += 2;
  for (unsigned bit = 0; bit < 12; ++bit)
    length += has(more, bit) ? 4 : 0;  // I, J, R, D, C, H, A, B, K, L, O
  if (!has(bits, 15)) return length;
  constexpr std::size_t longest_text = 80;
  const std::size_t text = bytes.size() > 4 ? static_cast<unsigned char>(bytes[4]) : 0U;
  return length + std::min(longest_text, text + 1);
}
}  // namespace

std::unique_ptr<Firmware> make_firmware(const Machine& machine, const Personality& personality,
                                        MoveSink& sink, Firmware::Reply reply) {
  if (personality.family == Personality::Family::repetier) {
    return std::make_unique<Repetier>(machine, personality, sink, std::move(reply));
  }
  if (personality.family == Personality::Family::reprapfirmware) {
    return std::make_unique<RepRapFirmware>(machine, personality, sink, std::move(reply));
  }
  return std::make_unique<Firmware>(machine, personality, sink, std::move(reply));
}

Repetier::Repetier(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply)
    : Firmware(machine, personality, sink, std::move(reply)) {
  forget();
}

void Repetier::forget() {
  waits_for_line_ = false;
  packet_.clear();
  idle_at_ = now_ + idle_interval;
  tools_.fill(equal_parts());
  live_ = equal_parts();
  selected_ = 0;
}

void Repetier::die(const std::string& reason) {
  say("fatal:" + reason +
      " - Printer stopped and heaters disabled due to this error. Fix error and restart with M999.");
  kill();
}

/// It does not halt: it switches all heaters off and acknowledges moves that it does not make.
void Repetier::alarm(Heater::Alarm what, bool bed) {
  if (what == Heater::Alarm::min_temp || what == Heater::Alarm::max_temp)
    say(bed ? "heated bed: temp sensor defect marked defect"
            : "extruder 0: temp sensor defect marked defect");
  else
    say("Error:One heater seems decoupled from thermistor - disabling all for safety!");
  stop_moving();
}

// ---- lines

void Repetier::repeated(std::int64_t number) {
  ++counts_.skipped;
  say(fmt::format("skip {}", number));
  say("ok");
}

/// After the first request it discards all input until it has the line, and repeats the request by its own
/// clock.
void Repetier::refuse(LineVerdict::Kind kind) {
  ++(kind == LineVerdict::Kind::wrong_number ? counts_.number_errors : counts_.checksum_errors);
  buffer_.flush();
  if (std::exchange(waits_for_line_, true)) return;
  if (kind == LineVerdict::Kind::wrong_checksum) say("Error:Wrong checksum");
  ask_for_line();
}

/// A line that begins with a byte from 0x80 is a binary packet to it.
bool Repetier::swallows(char byte) {
  ask_at_ = now_ + ask_interval;
  if (packet_.empty() && (!assembler_.at_line_start() || static_cast<unsigned char>(byte) < 0x80))
    return false;
  packet_ += byte;
  if (packet_.size() < 5 || packet_.size() < packet_length(packet_)) return true;
  packet_.clear();
  refuse(LineVerdict::Kind::wrong_checksum);
  return true;
}

void Repetier::threw_line_away() {
  if (!std::exchange(waits_for_line_, true)) ask_for_line();
}

void Repetier::ask_for_line() {
  ++counts_.resends;
  ask_at_ = now_ + ask_interval;
  buffer_.flush();
  assembler_.reset();
  packet_.clear();
  say("");
  say(fmt::format("Resend:{}", check_.last() + 1));
  say("ok");
}

bool Repetier::handled_at_once(std::string_view line) {
  if (!line.starts_with("M112")) return false;
  emergency_stop({'M', 112});
  return true;
}

void Repetier::taken(const Line& line) {
  if (line.number) waits_for_line_ = false;
  say(line.body.starts_with("M110") ? "ok" : fmt::format("ok {}", check_.last()));
}

void Repetier::done(const Line&) {
  idle_at_ = now_ + idle_interval;
}

/// It has asked for a line, or one has begun and does not go on.
bool Repetier::misses_a_line() const {
  const bool reads = queue_.size() < personality_.queue_size;
  return reads && (waits_for_line_ || !packet_.empty() || !assembler_.at_line_start());
}

std::optional<double> Repetier::next_habit() const {
  if (misses_a_line()) return ask_at_;
  return idle() ? std::optional(idle_at_) : std::nullopt;
}

void Repetier::follow_habits() {
  if (misses_a_line() && now_ >= ask_at_) ask_for_line();
  if (!idle() || now_ < idle_at_) return;
  idle_at_ = now_ + idle_interval;
  say("wait");
}

// ---- commands

/// A line of a number only is used up. What others keep in an EEPROM, this build does not.
void Repetier::execute(const std::string& body) {
  if (body.empty()) return;
  const auto command = parse_command(body);
  const auto is = [&](int code) { return command && command->is('M', code); };
  if (is(205) || is(500) || is(501) || is(502)) return say("Error:No EEPROM support compiled.");
  Firmware::execute(body);
}

/// It repeats the command as it has understood it, each word with a space behind it.
void Repetier::say_unknown(const std::string& body) {
  const auto& number = queue_.front().number;
  say(fmt::format("Unknown command:{}{} ", number ? fmt::format("N{} ", *number) : "", body));
}

bool Repetier::knows(const Command& command) const {
  constexpr std::array unknown{0, 1, 31, 73, 75, 76, 77, 108, 113, 118, 165, 211, 410, 412, 503, 600, 876};
  if (command.is('M', 155) && !personality_.capabilities) return false;
  return command.letter() != 'M' ||
         std::find(unknown.begin(), unknown.end(), command.code()) == unknown.end();
}

std::string Repetier::temperatures() const {
  return fmt::format("T:{:.2f} /{:.0f} B:{:.2f} /{:.0f}", nozzle_.temperature(now_), nozzle_.target(),
                     bed_.temperature(now_), bed_.target());
}

void Repetier::nozzle_target(const Command& command) {
  Firmware::nozzle_target(command);
  say(fmt::format("TargetExtr0:{:.0f}", nozzle_.target()));
}

void Repetier::wait_nozzle(const Command& command) {
  Firmware::wait_nozzle(command);
  say(fmt::format("TargetExtr0:{:.0f}", nozzle_.target()));
}

void Repetier::bed_target(const Command& command) {
  Firmware::bed_target(command);
  say(fmt::format("TargetBed:{:.0f}", bed_.target()));
}

void Repetier::wait_bed(const Command& command) {
  Firmware::wait_bed(command);
  say(fmt::format("TargetBed:{:.0f}", bed_.target()));
}

void Repetier::feed_percent(const Command& command) {
  if (const auto percent = command.value('S')) coordinates_.set_feed_percent(*percent);
  say(fmt::format("SpeedMultiply:{:.0f}", 100 * coordinates_.feed()));
}

void Repetier::flow_percent(const Command& command) {
  if (const auto percent = command.value('S')) coordinates_.set_flow_percent(*percent);
  say(fmt::format("FlowMultiply:{:.0f}", 100 * coordinates_.flow()));
}

void Repetier::fan(const Command& command) {
  say(fmt::format("Fanspeed:{:.0f}", command.code() == 107 ? 0 : command.value_or('S', 255)));
}

/// It does not wait: it reports the end of the last move that it has taken.
void Repetier::report_position(const Command&) {
  say(fmt::format("X:{:.2f} Y:{:.2f} Z:{:.3f} E:{:.4f}", coordinates_.logical(axis_x),
                  coordinates_.logical(axis_y), coordinates_.logical(axis_z), coordinates_.e()));
}

void Repetier::report_temperatures(const Command&) {
  say(temperatures());
}

/// The board restarts through its watchdog.
void Repetier::emergency_stop(const Command&) {
  reset();
}

void Repetier::report_firmware(const Command&) {
  say("FIRMWARE_NAME:Repetier_1.0.4 (simulated) COMPILED:none MACHINE_TYPE:unicursal simulator "
      "EXTRUDER_COUNT:" +
      std::to_string(machine_.feeders) + " REPETIER_PROTOCOL:3");
  if (!personality_.capabilities) return;
  for (const char* one :
       {"PROGRESS:0", "AUTOREPORT_TEMP:1", "EEPROM:0", "AUTOLEVEL:0", "Z_PROBE:0", "LEVELING_DATA:0",
        "SOFTWARE_POWER:0", "TOGGLE_LIGHTS:0", "CASE_LIGHT_BRIGHTNESS:0", "PAUSESTOP:1", "PREHEAT:1"})
    say(std::string("Cap:") + one);
}

/// P is read as an integer, and acts at once on everything that is still to be fed.
void Repetier::collect_share(const Command& command) {
  const double feeder = command.value_or('S', 0);
  if (feeder < 0 || feeder >= static_cast<double>(machine_.feeders)) return;
  Factors weights = live_;
  const double weight = std::clamp(command.value_or('P', 0), 0.0, static_cast<double>(heaviest));
  weights[static_cast<std::size_t>(feeder)] = static_cast<std::int32_t>(weight);
  mix_live(weights);
}

void Repetier::mix_live(const Factors& weights) {
  live_ = weights;
  planner_.remix(current_mix(), now_);
}

void Repetier::store_mixture(const Command& command) {
  const double tool = command.value_or('S', -1);
  if (tool < 0 || tool >= static_cast<double>(tools)) return;
  tools_[static_cast<std::size_t>(tool)] = live_;
}

void Repetier::select_tool(const Command& command) {
  const int tool = command.code() < static_cast<int>(tools) ? command.code() : 0;
  wait_until_still([this, tool] {
    selected_ = tool;
    mix_live(tools_[static_cast<std::size_t>(tool)]);
    say("SelectExtruder:0");
  });
}

Factors Repetier::equal_parts() const {
  constexpr std::int32_t one_part = 100;
  Factors factors{};
  std::fill_n(factors.begin(), machine_.feeders, one_part);
  return factors;
}

}  // namespace unicursal::sim
