#include "sim/firmware/repetier.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {
constexpr double ask_interval = 0.2;      // s between requests for the same line
constexpr double idle_interval = 1;       // s without a command after which it says "wait"
constexpr std::int32_t heaviest = 30000;  // weights are 16-bit integers
}  // namespace

std::unique_ptr<Firmware> make_firmware(const Machine& machine, const Personality& personality,
                                        MoveSink& sink, Firmware::Reply reply) {
  if (personality.family == Personality::Family::repetier) {
    return std::make_unique<Repetier>(machine, personality, sink, std::move(reply));
  }
  return std::make_unique<Firmware>(machine, personality, sink, std::move(reply));
}

Repetier::Repetier(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply)
    : Firmware(machine, personality, sink, std::move(reply)) {
  forget();
}

void Repetier::forget() {
  waits_for_line_ = false;
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
  ask_for_line();
}

void Repetier::ask_for_line() {
  ++counts_.resends;
  ask_at_ = now_ + ask_interval;
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
  say(fmt::format("ok {}", check_.last()));
}

void Repetier::done(const Line&) {
  idle_at_ = now_ + idle_interval;
}

std::optional<double> Repetier::next_habit() const {
  if (waits_for_line_) return ask_at_;
  return idle() ? std::optional(idle_at_) : std::nullopt;
}

void Repetier::follow_habits() {
  if (waits_for_line_ && now_ >= ask_at_) ask_for_line();
  if (!idle() || now_ < idle_at_) return;
  idle_at_ = now_ + idle_interval;
  say("wait");
}

// ---- commands

void Repetier::say_unknown(const std::string& body) {
  say("Unknown command:" + body);
}

bool Repetier::knows(const Command& command) const {
  return !command.is('M', 108) && !command.is('M', 165) && !command.is('M', 410);
}

std::string Repetier::temperatures() const {
  return fmt::format("T:{:.2f} /{:.0f} B:{:.2f} /{:.0f}", nozzle_.temperature(now_), nozzle_.target(),
                     bed_.temperature(now_), bed_.target());
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
      "EXTRUDER_COUNT:1");
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
  });
}

Factors Repetier::equal_parts() const {
  constexpr std::int32_t one_part = 100;
  Factors factors{};
  std::fill_n(factors.begin(), machine_.feeders, one_part);
  return factors;
}

}  // namespace unicursal::sim
