#include "sim/printer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace unicursal::sim {

namespace {
constexpr std::size_t longest_delivery = 1024;  // bytes handed to the computer at once
}

Printer::Printer(const Machine& machine, const Personality& personality, const WireModel& wire,
                 const FaultPlan& faults, MoveSink& sink)
    : wire_(wire),
      faults_(faults),
      firmware_(make_firmware(machine, personality, sink, [this](std::string_view line) { say(line); })) {
  firmware_->watch_lines([this](std::string_view line) { return faults_.received(line); });
  if (const auto seconds = faults_.boot_seconds()) firmware_->set_boot_seconds(*seconds);
  for (const Fault& work : faults_.long_works())
    firmware_->lengthen(*work.command, work.seconds, work.kind == FaultKind::chatty_work);
}

void Printer::opened(bool dtr_rises) {
  if (!std::exchange(powered_, true)) {
    firmware_->boot();
  } else if (dtr_rises && firmware_->personality().resets_on_open) {
    wire_.cut();
    firmware_->reset();
  }
}

void Printer::write(std::string_view bytes) {
  if (!unplugged()) wire_.write(now_, faults_.to_printer(bytes));
}

void Printer::say(std::string_view line) {
  const double at = firmware_->now() + faults_.delay();
  if (!unplugged()) wire_.speak(at, faults_.from_printer(line));
}

std::optional<double> Printer::next_event() const {
  std::optional<double> next;
  const auto consider = [&next](std::optional<double> time) {
    if (time) next = std::min(next.value_or(*time), *time);
  };
  consider(firmware_->next_event());
  consider(wire_.next_arrival());
  consider(wire_.next_delivery());
  consider(faults_.next_time());
  return next;
}

bool Printer::busy() const {
  return wire_.next_arrival() || wire_.next_delivery() || firmware_->blocked();
}

bool Printer::advance(double until, std::uint64_t most_steps) {
  deliver();
  const bool was_unplugged = unplugged();
  const auto something = [&] { return has_output() || unplugged() != was_unplugged; };
  while (!something()) {
    const auto next = next_event();
    if (!next || *next > until) break;
    if (most_steps-- == 0) return false;
    step(*next);
  }
  if (!something() && until < std::numeric_limits<double>::infinity() && until > now_) step(until);
  return true;
}

/// Processes everything that is due at `time`. Precondition: nothing is due earlier.
void Printer::step(double time) {
  now_ = std::max(now_, time);
  receive(std::nextafter(now_, 0.0));  // the beginning of the line may have filled the buffer already
  firmware_->advance(now_);
  receive(now_);
  for (const Fault& fault : faults_.due(now_)) strike(fault);
  deliver();
}

void Printer::receive(double until) {
  const std::vector<WireByte> arrived = wire_.arrive(until);
  if (!arrived.empty()) firmware_->receive(arrived);
}

void Printer::deliver() {
  if (!unplugged()) output_ += wire_.deliver(now_, longest_delivery);
}

void Printer::strike(const Fault& fault) {
  constexpr double for_ever = std::numeric_limits<double>::infinity();
  Heater& nozzle = firmware_->nozzle();
  switch (fault.kind) {
    case FaultKind::stall:
      return firmware_->stall(fault.seconds);
    case FaultKind::silence:
      return firmware_->stall(for_ever);
    case FaultKind::disconnect:
      wire_.cut();
      plug_at_ = fault.seconds > 0 ? now_ + fault.seconds : for_ever;
      return;
    case FaultKind::reset:
      return firmware_->reset();
    case FaultKind::heater_failure:
      return nozzle.break_down(now_, Heater::Defect::open);
    case FaultKind::bed_failure:
      return firmware_->bed().break_down(now_, Heater::Defect::open);
    case FaultKind::unguarded:
      nozzle.leave_unguarded();
      return firmware_->bed().leave_unguarded();
    case FaultKind::runaway:
      return nozzle.break_down(now_, Heater::Defect::closed);
    case FaultKind::thermistor:
      return nozzle.pull_thermistor(now_);
    case FaultKind::runout:
      return firmware_->run_out("M600");  // the stock script
    case FaultKind::filament_change:
      return firmware_->run_out("M600 T0");
    case FaultKind::say:
      return say(fault.text);
    case FaultKind::display:
      return firmware_->enter(fault.text);
    case FaultKind::fatal:
      return firmware_->die(fault.text);
    case FaultKind::stopped:
      return firmware_->stop_moving();
    default:
      return;  // the other kinds affect bytes and lines
  }
}

void Printer::run_down() {
  while (const auto next = wire_.next_arrival()) step(*next);
  firmware_->run_down();
  now_ = std::max(now_, firmware_->now());
}

}  // namespace unicursal::sim
