#include "sim/firmware/firmware.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {
constexpr double busy_interval = 2;  // s between busy lines
constexpr double heat_interval = 1;  // s between the lines of M109 and M190
constexpr double residency = 10;     // s that a heater must have been hot for M109 and M190
}  // namespace

Firmware::Firmware(const Machine& machine, MoveSink& sink, Reply reply)
    : machine_(machine),
      reply_(std::move(reply)),
      planner_(machine.limits, sink),
      coordinates_(machine.bed),
      mixer_(machine.feeders),
      nozzle_(machine.nozzle),
      bed_(machine.bed_heater) {}

void Firmware::boot() {
  for (const char* line :
       {"start", "PowerUp", "Marlin 2.1.2", "", "echo: Simulated printer with a mixing extruder",
        "echo: Free Memory: 65536  PlannerBufferBytes: 2048", "echo:Hardcoded Default Settings Loaded"}) {
    reply_(line);
  }
}

void Firmware::receive(std::string_view bytes) {
  while (!bytes.empty() && buffer_.room() > 0 && !dead()) {
    const std::size_t portion = std::min(bytes.size(), buffer_.room());
    buffer_.push(bytes.substr(0, portion));
    bytes.remove_prefix(portion);
    settle();
  }
  if (!dead()) buffer_.push(bytes);
}

void Firmware::advance(double until) {
  settle();
  for (auto next = next_event(); next && *next <= until; next = next_event()) {
    now_ = std::max(now_, *next);
    if (!planner_.still()) active_at_ = now_;
    planner_.advance_to(now_);
    settle();
    tick();
  }
  if (dead()) return;
  now_ = std::max(now_, until);
  planner_.advance_to(now_);
}

std::optional<double> Firmware::next_event() const {
  if (dead()) return std::nullopt;
  std::optional<double> next = planner_.next_event();
  const auto consider = [&next](double time) { next = std::min(next.value_or(time), time); };
  if (running_) consider(busy_at_);
  if (report_interval_ > 0) consider(report_at_);
  if (inactivity_ > 0 && !running_ && planner_.still()) consider(active_at_ + inactivity_);
  if (!waits_.empty() && waits_.front().what == Wait::For::time) consider(waits_.front().until);
  if (!waits_.empty() && waits_.front().settled) consider(heat_report_at_);
  return next;
}

void Firmware::run_down() {
  settle();
  while (!dead() && (running_ || !planner_.still())) advance(*next_event());
}

void Firmware::settle() {
  while (!dead()) {
    read_lines();
    if (dead() || queue_.empty()) return;
    if (!running_) start_next();
    if (!progress()) return;
    finish();
  }
}

void Firmware::read_lines() {
  while (queue_.size() < queue_size && !dead()) {
    const auto byte = buffer_.pop();
    if (!byte) return;
    if (const auto line = assembler_.push(*byte)) take(*line);
  }
}

void Firmware::take(const std::string& line) {
  ++counts_.received;
  LineVerdict verdict = check_.check(line);
  if (verdict.kind == LineVerdict::Kind::repeated) {
    ++counts_.repeated;
  } else if (verdict.kind != LineVerdict::Kind::accepted) {
    refuse(verdict.kind);
  } else {
    if (verdict.number) ++counts_.accepted;
    if (verdict.number || !handled_at_once(verdict.body)) {
      queue_.push_back({verdict.number, std::move(verdict.body)});
    }
  }
}

void Firmware::refuse(LineVerdict::Kind kind) {
  ++(kind == LineVerdict::Kind::wrong_number ? counts_.number_errors : counts_.checksum_errors);
  ++counts_.resends;
  buffer_.flush();
  reply_("Error:" + refusal(kind, check_.last()));
  reply_(fmt::format("Resend: {}", check_.last() + 1));
  reply_("ok");
}

/// Without a number, three commands act when they are received, ahead of the queue. Only a kill ends there;
/// the others are queued as well and answered in their turn.
bool Firmware::handled_at_once(std::string_view line) {
  if (line.starts_with("M112")) {
    reply_("echo:M112 Shutdown");
    kill();
    return true;
  }
  if (line.starts_with("M108") && !waits_.empty() && waits_.front().settled) waits_.pop_front();
  if (line.starts_with("M410")) quick_stop();
  return false;
}

void Firmware::start_next() {
  running_ = true;
  answers_ok_ = true;
  busy_at_ = now_ + busy_interval;
  active_at_ = now_;
  execute(queue_.front().body);
}

bool Firmware::progress() {
  while (!waits_.empty() && !dead()) {
    if (!over(waits_.front())) return false;
    const auto then = std::move(waits_.front().then);
    waits_.pop_front();
    if (then) then();
  }
  return !dead();
}

bool Firmware::over(const Wait& wait) const {
  switch (wait.what) {
    case Wait::For::room:
      return planner_.has_room();
    case Wait::For::stillness:
      return planner_.still();
    case Wait::For::time:
      return now_ >= wait.until;
  }
  return true;
}

void Firmware::finish() {
  ++counts_.executed;
  note_order(queue_.front());
  queue_.pop_front();
  running_ = false;
  active_at_ = now_;
  if (answers_ok_) reply_("ok");
}

void Firmware::note_order(const Line& line) {
  if (line.body.starts_with("M110")) {
    last_executed_ = check_.last();
  } else if (line.number) {
    counts_.executed_in_order = counts_.executed_in_order && *line.number == last_executed_ + 1;
    last_executed_ = *line.number;
  }
}

void Firmware::tick() {
  if (dead()) return;
  if (report_interval_ > 0 && now_ >= report_at_) {
    report_at_ += report_interval_;
    reply_(" " + temperatures());
  }
  if (!waits_.empty() && waits_.front().settled && now_ >= heat_report_at_) {
    heat_report_at_ += heat_interval;
    const Wait& wait = waits_.front();
    const std::string rest = now_ < *wait.settled ? "?" : fmt::format("{:.0f}", wait.until - now_);
    reply_(fmt::format(" {} W:{}", temperatures(), rest));
  }
  if (running_ && now_ >= busy_at_) {
    busy_at_ += busy_interval;
    reply_("echo:busy: processing");
  }
  if (inactivity_ > 0 && !running_ && planner_.still() && now_ >= active_at_ + inactivity_) {
    reply_("Error:!! KILL caused by too much inactive time - current command: ");
    warn("switched itself off after M85's time without a command");
    kill();
  }
}

void Firmware::kill() {
  reply_("Error:Printer halted. kill() called!");
  reply_("//action:poweroff");
  planner_.abort(now_);
  nozzle_.set_target(now_, 0);
  bed_.set_target(now_, 0);
  killed_ = true;
}

void Firmware::quick_stop() {
  planner_.abort(now_);
  if (!waits_.empty() && waits_.front().what == Wait::For::room) waits_.clear();
  const auto& steps = planner_.executed_position();
  const auto mm = [&](Axis axis) {
    return static_cast<double>(steps[axis]) / planner_.limits().steps_per_mm[axis];
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

void Firmware::wait_for_heater(Heater& heater, bool heating_only) {
  if (heating_only && heater.temperature(now_) > heater.target()) return;
  const double hot = heater.arrival(now_, heating_only);
  heat_report_at_ = now_ + heat_interval;
  waits_.push_back({Wait::For::time, hot + residency, nullptr, hot});
}

}  // namespace unicursal::sim
