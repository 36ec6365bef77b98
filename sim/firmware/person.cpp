// Waits for a person, as in Marlin 2.1 with ADVANCED_PAUSE_FEATURE (classes HostUI and EmergencyParser): M0,
// M600 and the end of the filament. The nozzle's way to its park position takes its time, but is not drawn.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

namespace {
constexpr double parking_seconds = 3, loading_seconds = 4, purging_seconds = 2;
}  // namespace

void Firmware::show_prompt(std::string_view text, std::initializer_list<std::string_view> buttons) {
  if (!personality_.host_prompts) return;
  say("//action:prompt_end");
  say(fmt::format("//action:prompt_begin {}", text));
  for (const std::string_view button : buttons) say(fmt::format("//action:prompt_button {}", button));
  say("//action:prompt_show");
}

/// Any answer will do.
void Firmware::wait_for_person(std::function<void()> then) {
  awaited_ = Awaited::anything;
  waits_.push_back({Wait::For::person, 0, std::move(then), std::nullopt});
}

/// M108 does not end this wait.
void Firmware::wait_for_choice(std::function<void()> then) {
  awaited_ = Awaited::choice;
  waits_.push_back({Wait::For::person, 0, std::move(then), std::nullopt});
}

void Firmware::person_came() {
  if (awaited_ == Awaited::anything) awaited_ = Awaited::nothing;
}

/// M876 S<button>.
void Firmware::answer_prompt(int button) {
  if (awaited_ == Awaited::anything) return person_came();
  if (awaited_ != Awaited::choice || button > 1) return;
  purge_more_ = button == 0;
  awaited_ = Awaited::nothing;
}

void Firmware::stop_for_person(const Command& command) {
  wait_until_still([this, command] {
    show_prompt(command.code() == 0 ? "M0 Stop" : "M1 Stop", {"Continue"});
    wait_for_person(nullptr);
  });
}

/// A printer whose feeders mix has no feeder of its own to change: without T the command is refused.
void Firmware::change_filament(const Command& command) {
  if (!command.has('T')) return say("echo:M600 E stepper not specified");
  wait_until_still([this] {
    say("//action:paused");
    show_prompt("Pause", {"Dismiss"});
    wait_seconds(parking_seconds, [this] {
      show_prompt("Nozzle Parked", {"Continue"});
      wait_for_person([this] { wait_seconds(loading_seconds, [this] { offer_purging(); }); });
    });
  });
}

void Firmware::offer_purging() {
  show_prompt("Paused", {"PurgeMore", ran_out_ ? "DisableRunout" : "Continue"});
  if (!personality_.host_prompts) return say("//action:resumed");
  wait_for_choice([this] {
    if (purge_more_) return wait_seconds(purging_seconds, [this] { offer_purging(); });
    if (std::exchange(ran_out_, false)) runout_sensor_ = false;
    show_prompt("Resuming", {"Dismiss"});
    say("//action:resumed");
  });
}

/// M412; S also forgets that filament has run out.
void Firmware::runout_sensor(const Command& command) {
  const auto on = command.value('S');
  if (!on) return say(fmt::format("echo:Filament runout {}", runout_sensor_ ? "ON" : "OFF"));
  runout_sensor_ = *on != 0;
  ran_out_ = false;
}

void Firmware::run_out(std::string script) {
  if (!runout_sensor_) return warn("filament ran out while its sensor was switched off");
  ran_out_ = true;
  say("//action:out_of_filament T0");
  say("//action:paused filament_runout 0");
  show_prompt("FilamentRunout T0", {"Continue"});
  enter(std::move(script));
}

void Firmware::enter(std::string command) {
  const auto behind_running = queue_.begin() + (running_ ? 1 : 0);
  queue_.insert(behind_running, Line{std::nullopt, std::move(command), true});
  settle();
}

void Firmware::say_busy() {
  say(awaited_ == Awaited::nothing ? "echo:busy: processing" : "echo:busy: paused for user");
}

/// Bytes are looked through when they arrive, ahead of every queue.
void Firmware::look_for_emergency(char byte) {
  constexpr std::size_t longest = 40;
  if (byte != '\n' && byte != '\r') {
    if (emergency_line_.size() < longest) emergency_line_ += byte;
    return;
  }
  std::string line = std::exchange(emergency_line_, {});
  if (line.starts_with('N')) line.erase(0, std::min(line.find(' ') + 1, line.size()));
  const auto command = parse_command(line);
  if (!command || command->letter() != 'M') return;
  switch (command->code()) {
    case 108:
      person_came();
      if (waits_for_heat()) waits_.pop_front();
      return;
    case 112:
      return emergency_stop(*command);
    case 410:
      return quick_stop();
    case 876:
      return answer_prompt(static_cast<int>(command->value_or('S', 0)));
    default:
      return;
  }
}

}  // namespace unicursal::sim
