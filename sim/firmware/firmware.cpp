#include "sim/firmware/firmware.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {

constexpr double longest_run_down = 7200;  // s; a heater that has failed never becomes hot
constexpr double heat_interval = 1;        // s between the lines of M109 and M190
constexpr double probe_interval = 3;       // s between the points that a long command reports
constexpr double heat_look = 0.25;         // s between checks of the temperature while M109 or M190 waits

LineCheck::Rules rules_of(const Personality& personality) {
  switch (personality.family) {
    case Personality::Family::repetier:
      return LineCheck::Rules::repetier;
    case Personality::Family::reprapfirmware:
      return LineCheck::Rules::reprapfirmware;
    case Personality::Family::marlin:
      break;
  }
  return LineCheck::Rules::marlin;
}

MotionLimits limits_of(const Machine& machine, const Personality& personality) {
  MotionLimits limits = machine.limits;
  if (limits.step_rate == 0) limits.step_rate = personality.step_rate;
  return limits;
}

}  // namespace

Firmware::Firmware(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply)
    : machine_(machine),
      personality_(personality),
      reply_(std::move(reply)),
      assembler_(personality.family == Personality::Family::repetier),
      check_(rules_of(personality)),
      planner_(limits_of(machine, personality), sink),
      coordinates_(machine.bed, machine.overtravel),
      mixer_(machine.feeders, personality.mix_scale, personality.virtual_tools),
      nozzle_(machine.nozzle),
      bed_(machine.bed_heater),
      cold_(personality.cold) {}

MotionLimits Firmware::original_limits() const {
  return limits_of(machine_, personality_);
}

// ---- power and reset

void Firmware::boot() {
  booting_ = true;
  boot_at_ = now_ + personality_.boot_seconds;
}

void Firmware::wake_up() {
  booting_ = false;
  for (const std::string& line : personality_.chatter) say(line);
  forget();
}

void Firmware::reset() {
  ++counts_.resets;
  planner_.reset(now_);
  planner_.limits() = limits_of(machine_, personality_);
  origin_ = planner_.executed_position();
  origin_[axis_e] = 0;
  coordinates_ = Coordinates(machine_.bed, machine_.overtravel);
  mixer_ = Mixer(machine_.feeders, personality_.mix_scale, personality_.virtual_tools);
  cold_ = personality_.cold;
  busy_interval_ = 2;
  awaited_ = Awaited::nothing;
  runout_sensor_ = true;
  ran_out_ = at_long_work_ = false;
  emergency_line_.clear();
  screen_ = {};
  check_.set_last(0);
  last_executed_ = 0;
  buffer_.flush();
  assembler_.reset();
  queue_.clear();
  waits_.clear();
  running_ = killed_ = stopped_ = false;
  stalled_until_ = report_interval_ = inactivity_ = 0;
  nozzle_.reset(now_);
  bed_.reset(now_);
  boot();
}

void Firmware::die(const std::string& reason) {
  say("Error:" + reason);
  kill();
}

void Firmware::stop_moving() {
  say_stopped();
  nozzle_.reset(now_);
  bed_.reset(now_);
  stopped_ = true;
}

void Firmware::kill() {
  say("Error:Printer halted. kill() called!");
  say("//action:poweroff");
  planner_.abort(now_);
  nozzle_.reset(now_);
  bed_.reset(now_);
  killed_ = true;
}

// ---- time

void Firmware::advance(double until) {
  settle();
  for (auto next = next_event(); next && *next <= until; next = next_event()) {
    now_ = std::max(now_, *next);
    if (booting_) {
      wake_up();
      continue;
    }
    if (!planner_.still()) active_at_ = now_;
    planner_.advance_to(now_);
    settle();
    tick();
  }
  now_ = std::max(now_, until);
  if (!dead()) planner_.advance_to(now_);
}

std::optional<double> Firmware::next_event() const {
  if (booting_) return boot_at_;
  if (dead()) return std::nullopt;
  std::optional<double> next = planner_.next_event();
  const auto consider = [&next](std::optional<double> time) {
    if (time) next = std::min(next.value_or(*time), *time);
  };
  consider(nozzle_.next_tick());
  consider(bed_.next_tick());
  if (frozen()) {
    if (!silent()) consider(stalled_until_);
    return next;
  }
  if (running_ && !at_long_work_ && busy_interval_ > 0) consider(busy_at_);
  if (report_interval_ > 0) consider(report_at_);
  if (inactivity_ > 0 && !running_ && planner_.still()) consider(active_at_ + inactivity_);
  if (!waits_.empty() && waits_.front().until > 0) consider(waits_.front().until);
  if (waits_for_heat()) consider(heat_report_at_);
  consider(next_habit());
  return next;
}

void Firmware::run_down() {
  if (booting_) advance(boot_at_);
  if (frozen() && !silent()) advance(stalled_until_);
  settle();
  const double end = now_ + longest_run_down;
  while (!dead() && !frozen() && awaited_ == Awaited::nothing && now_ < end &&
         (running_ || !planner_.still()))
    advance(*next_event());
}

void Firmware::tick() {
  tick_heaters();
  if (dead() || frozen()) return;
  if (report_interval_ > 0 && now_ >= report_at_) {
    report_at_ = now_ + report_interval_;
    say(" " + temperatures());
  }
  if (waits_for_heat() && now_ >= heat_report_at_) {
    heat_report_at_ = now_ + heat_interval;
    say_heating(*waits_.front().heat);
  }
  if (running_ && !at_long_work_ && busy_interval_ > 0 && now_ >= busy_at_) {
    busy_at_ = now_ + busy_interval_;
    say_busy();
  }
  follow_habits();
  if (inactivity_ > 0 && !running_ && planner_.still() && now_ >= active_at_ + inactivity_) {
    warn("switched itself off after M85's time without a command");
    die("!! KILL caused by too much inactive time - current command: ");
  }
}

void Firmware::tick_heaters() {
  for (Heater* heater : {&nozzle_, &bed_}) {
    if (dead()) return;
    const auto trouble = heater->tick(now_);
    if (!trouble) continue;
    warn(sentence(*trouble));
    alarm(*trouble, heater == &bed_);
  }
}

void Firmware::alarm(Heater::Alarm what, bool bed) {
  die(fmt::format("{}, system stopped! Heater_ID: {}", sentence(what), bed ? "bed" : "0"));
}

void Firmware::say_heating(const HeatWait& wait) {
  const std::string rest = wait.since ? fmt::format("{:.0f}", *wait.since + residency() - now_) : "?";
  say(fmt::format(" {} W:{}", temperatures(), rest));
}

// ---- lines in

void Firmware::receive(std::string_view bytes) {
  std::vector<WireByte> intact;
  for (const char byte : bytes) intact.push_back({byte, false});
  receive(intact);
}

void Firmware::receive(const std::vector<WireByte>& bytes) {
  if (booting_) counts_.while_booting += bytes.size();
  if (booting_) return;
  for (const WireByte& byte : bytes) {
    if (buffer_.room() == 0) settle();
    if (personality_.emergency_parser && !dead()) look_for_emergency(byte.value);
    if (booting_) return;
    buffer_.push(byte);
  }
  settle();
}

void Firmware::settle() {
  while (!dead() && !frozen() && !booting_) {
    read_lines();
    if (dead() || booting_ || queue_.empty()) return;
    if (!running_) start_next();
    if (!progress()) return;
    finish();
  }
}

void Firmware::read_lines() {
  while (queue_.size() < personality_.queue_size && !dead() && !booting_ && !frozen()) {
    const auto byte = buffer_.pop();
    if (!byte) return;
    line_damaged_ = line_damaged_ || byte->damaged;
    if (swallows(byte->value)) continue;
    const auto line = assembler_.push(byte->value);
    if (line) take(*line, line_damaged_);
    if (assembler_.threw_away()) threw_line_away();
    if (byte->value == '\n' || byte->value == '\r' || byte->value == '\0') line_damaged_ = false;
  }
}

void Firmware::take(const std::string& line, bool damaged) {
  using Kind = LineVerdict::Kind;
  ++counts_.received;
  const Misreading misreading = watch_ ? watch_(line) : Misreading::none;
  if (misreading == Misreading::damaged) return refuse(Kind::wrong_checksum);
  if (misreading == Misreading::misnumbered) return refuse(Kind::wrong_number);
  if (misreading == Misreading::unchecked) return refuse(Kind::no_checksum);
  LineVerdict verdict = check_.check(line);
  if (verdict.kind == Kind::repeated) return repeated(*verdict.number);
  if (verdict.kind != Kind::accepted) return refuse(verdict.kind);
  const bool forgotten = verdict.number && misreading == Misreading::forgotten;
  accept(std::move(verdict), damaged);
  if (!forgotten) return;
  check_.set_last(check_.last() - 1);
  refuse(Kind::wrong_number);
}

void Firmware::accept(LineVerdict verdict, bool damaged) {
  // A print has no line 0: hosts set the number and ask questions with it.
  const bool asks = verdict.number == 0 && !verdict.body.starts_with("M110");
  if (verdict.number && !asks) ++counts_.accepted;
  if (damaged) ++(verdict.number ? counts_.unseen_damage : counts_.disguised);
  if (!verdict.number && handled_at_once(verdict.body)) return;
  std::vector<std::string> commands = commands_in(verdict.body);
  for (std::string& command : commands) queue_.push_back({std::nullopt, std::move(command), false, true});
  queue_.back().number = verdict.number;
  queue_.back().more = false;
  taken(queue_.back());
}

void Firmware::refuse(LineVerdict::Kind kind) {
  ++(kind == LineVerdict::Kind::wrong_number ? counts_.number_errors : counts_.checksum_errors);
  ++counts_.resends;
  buffer_.flush();
  say("Error:" + refusal(kind, check_.last()));
  say(fmt::format("Resend: {}", check_.last() + 1));
  say("ok");
}

/// Three unnumbered commands act as soon as they are received, ahead of the queue. M112 ends there; M108 and
/// M410 are queued as well, and answered in their turn.
bool Firmware::handled_at_once(std::string_view line) {
  if (personality_.emergency_parser) return false;  // they have acted already, and are answered in their turn
  if (line.starts_with("M112")) {
    emergency_stop({'M', 112});
    return true;
  }
  if (line.starts_with("M108")) {
    person_came();
    if (waits_for_heat()) waits_.pop_front();
  }
  if (line.starts_with("M876")) {
    const auto command = parse_command(line);
    answer_prompt(static_cast<int>(command->value_or('S', 0)));
  }
  if (line.starts_with("M410")) quick_stop();
  return false;
}

// ---- commands, one at a time

void Firmware::start_next() {
  running_ = true;
  answers_ok_ = true;
  busy_at_ = now_ + busy_interval_;
  active_at_ = now_;
  const std::string& body = queue_.front().body;
  if (command_watch_) command_watch_(body);
  const auto is = [&](const LongWork& work) {
    return body == work.word || body.starts_with(work.word + ' ');
  };
  const auto work = std::find_if(long_works_.begin(), long_works_.end(), is);
  at_long_work_ = work != long_works_.end();
  const auto command = parse_command(body);
  if (!at_long_work_ || (command && handles(*command))) execute(body);
  if (at_long_work_) work_on(work->seconds, work->chatty);
}

void Firmware::work_on(double seconds, bool chatty) {
  const double step = std::min(seconds, probe_interval), rest = seconds - step;
  wait_seconds(step, [this, rest, chatty] {
    if (rest <= 0) return;
    if (chatty) say("Bed X: 100.000 Y: 100.000 Z: 0.012");
    work_on(rest, chatty);
  });
}

void Firmware::lengthen(std::string_view word, double seconds, bool chatty) {
  long_works_.push_back({std::string(word), seconds, chatty});
}

bool Firmware::progress() {
  while (!waits_.empty() && !dead()) {
    if (!over(waits_.front())) return false;
    const auto then = std::move(waits_.front().then);
    waits_.pop_front();
    if (then) then();
  }
  return running_ && !dead();
}

bool Firmware::over(Wait& wait) {
  switch (wait.what) {
    case Wait::For::room:
      return planner_.has_room();
    case Wait::For::stillness:
      return planner_.still();
    case Wait::For::time:
      return now_ >= wait.until;
    case Wait::For::heat:
      return hot_for_long(wait);
    case Wait::For::person:
      return awaited_ == Awaited::nothing;
  }
  return true;
}

/// As Marlin's TEMP_RESIDENCY_TIME: the time starts at the target, and starts again when the heater strays.
bool Firmware::hot_for_long(Wait& wait) {
  HeatWait& heat = *wait.heat;
  if (!heat.since && heat.heater->arrived(now_, heat.heating_only)) heat.since = now_;
  if (heat.since && !heat.heating_only && heat.heater->strayed(now_)) heat.since.reset();
  wait.until = now_ + heat_look;
  if (!heat.since) return false;
  wait.until = std::min(wait.until, *heat.since + residency());
  return now_ >= *heat.since + residency();
}

void Firmware::finish() {
  ++counts_.executed;
  note_order(queue_.front());
  active_at_ = now_;
  done(queue_.front());
  queue_.pop_front();
  running_ = at_long_work_ = false;
}

void Firmware::done(const Line& line) {
  if (!answers_ok_ || line.injected) return;
  if (!personality_.advanced_ok) return say("ok");
  const std::string number = line.number ? fmt::format(" N{}", *line.number) : "";
  say(fmt::format("ok{} P{} B{}", number, planner_.free_slots(), personality_.queue_size - queue_.size()));
}

void Firmware::note_order(const Line& line) {
  if (line.injected) return;
  if (line.body.starts_with("M110")) {
    last_executed_ = check_.last();
  } else if (line.number && *line.number != 0) {
    counts_.executed_in_order = counts_.executed_in_order && *line.number == last_executed_ + 1;
    last_executed_ = *line.number;
  }
}

void Firmware::quick_stop() {
  planner_.abort(now_);
  if (!waits_.empty() && waits_.front().what == Wait::For::room) waits_.clear();
  const auto& steps = planner_.executed_position();
  const auto mm = [&](Axis axis) {
    return static_cast<double>(steps[axis] - origin_[axis]) / planner_.limits().steps_per_mm[axis];
  };
  const double unfed = filament_ - mm(axis_e);
  filament_ -= unfed;
  coordinates_.stopped_at({mm(axis_x), mm(axis_y), mm(axis_z)},
                          coordinates_.e() - unfed / coordinates_.flow());
}

void Firmware::wait_for_room(std::function<void()> then) {
  waits_.push_back({Wait::For::room, 0, std::move(then), std::nullopt});
}

void Firmware::wait_until_still(std::function<void()> then) {
  planner_.stop_is_meant();
  waits_.push_back({Wait::For::stillness, 0, std::move(then), std::nullopt});
}

void Firmware::wait_seconds(double seconds, std::function<void()> then) {
  waits_.push_back({Wait::For::time, now_ + seconds, std::move(then), std::nullopt});
}

void Firmware::wait_for_heater(const Heater& heater, bool heating_only) {
  if (heating_only && heater.temperature(now_) > heater.target()) return;
  heat_report_at_ = now_ + heat_interval;
  waits_.push_back(
      {Wait::For::heat, now_ + heat_look, nullptr, HeatWait{&heater, heating_only, std::nullopt}});
}

}  // namespace unicursal::sim
