#include "host/engine/heat_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/engine/seconds.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto patience = 10s;      ///< with a heater that is too cold or too hot
constexpr auto long_fall = 5s;      ///< six reports
constexpr auto long_off = 2s;       ///< three reports
constexpr double still_rising = 2;  ///< °C

/// A nozzle whose heater is off loses 1 to 2 °C/s at first; a fan that has been switched on costs less.
constexpr HeaterWatch::Rules nozzle_rules{15, 6, 0.8, 15};
/// A bed has much more mass, and a part comes off before the bed is cold.
constexpr HeaterWatch::Rules bed_rules{6, 4, 0.8, 15};

std::string heat_sentence(const char* heater, HeatTrouble what, double reading, double target) {
  switch (what) {
    case HeatTrouble::cold:
      return fmt::format(
          "the {} has fallen to {:.0f} °C, although it should have {:.0f} °C: its heater or sensor may have "
          "failed; check them and the part before you resume",
          heater, reading, target);
    case HeatTrouble::off:
      return fmt::format(
          "the printer has switched off the heat of its {}, which should have {:.0f} °C: find out why, and "
          "check the part, before you resume",
          heater, target);
    case HeatTrouble::hot:
      break;
  }
  return fmt::format(
      "the {} is at {:.0f} °C, although it should have {:.0f} °C, and becomes hotter: if it does not cool "
      "now, switch the printer off by its own switch",
      heater, reading, target);
}

}  // namespace

std::optional<HeatTrouble> HeaterWatch::note(TimePoint at, double reading, std::optional<double> reported,
                                             double wanted) {
  if (wanted <= 0) {
    rest();
    return std::nullopt;
  }
  const bool off = is_off(at, reported, wanted);
  raise_level(reading, reported && *reported > 0 ? *reported : wanted);
  const bool cold = is_cold(at, reading), hot = is_hot(at, reading);
  last_ = reading;
  if (off) return HeatTrouble::off;
  if (cold) return HeatTrouble::cold;
  if (hot) return HeatTrouble::hot;
  return std::nullopt;
}

/// Lines that set a target may wait behind moves, so only a target that the firmware had can be lost.
bool HeaterWatch::is_off(TimePoint at, std::optional<double> reported, double wanted) {
  if (wanted != wanted_) wanted_ = wanted, confirmed_ = false;
  if (!reported || *reported > 0 || !confirmed_) {
    confirmed_ = confirmed_ || (reported && *reported > 0);
    off_since_.reset();
    return false;
  }
  if (!off_since_) off_since_ = at;
  return at - *off_since_ >= long_off;
}

void HeaterWatch::raise_level(double reading, double target) {
  if (!target_ || target > *target_)
    level_ = reading;
  else if (target < *target_)
    beyond_since_.reset();
  target_ = target;
  level_ = std::min(std::max(level_, reading), target);
}

bool HeaterWatch::is_cold(TimePoint at, double reading) {
  // One that cools to a lower target is not heated; it has fallen by what it is below that target.
  if (!falls_from_ || reading >= last_ || reading > level_) falls_from_ = Mark{at, reading};
  const double lost = falls_from_->reading - reading;
  const bool fallen = at - falls_from_->at >= long_fall &&
                      lost >= rules_.rate * seconds(at - falls_from_->at) &&
                      reading <= level_ - rules_.fallen &&
                      last_ <= level_ - rules_.fallen / 2;  // one garbled report is not a fall
  if (reading > level_ - rules_.behind)
    behind_since_.reset();
  else if (!behind_since_)
    behind_since_ = at;
  return fallen || (behind_since_ && at - *behind_since_ >= patience);
}

/// One that cools after its target was lowered is not too hot.
bool HeaterWatch::is_hot(TimePoint at, double reading) {
  if (reading < *target_ + rules_.beyond)
    beyond_since_.reset();
  else if (!beyond_since_ || reading < beyond_since_->reading)
    beyond_since_ = Mark{at, reading};
  return beyond_since_ && at - beyond_since_->at >= patience &&
         reading >= beyond_since_->reading + still_rising;
}

HeatWatch::HeatWatch() : nozzle_(nozzle_rules), bed_(bed_rules) {}

std::optional<HeatWatch::Trouble> HeatWatch::note(TimePoint at, const gcode::Temperatures& reported,
                                                  double nozzle, double bed) {
  std::optional<Trouble> trouble;
  const auto look = [&](HeaterWatch& watch, const char* name, std::optional<double> reading,
                        std::optional<double> target, double wanted) {
    if (!reading) return;
    const auto what = watch.note(at, *reading, target, wanted);
    if (what && !trouble) trouble = Trouble{*what, heat_sentence(name, *what, *reading, wanted), false};
  };
  look(nozzle_, "nozzle", reported.nozzle, reported.nozzle_target, nozzle);
  look(bed_, "bed", reported.bed, reported.bed_target, bed);
  // A firmware that finds a fault of the bed stops itself, or switches the nozzle off as well.
  const bool nozzle_on = !reported.nozzle_target || *reported.nozzle_target > 0;
  if (trouble && trouble->what == HeatTrouble::off && nozzle_on) {
    trouble->meant = true;
    trouble->why =
        "the bed was switched off at the printer, and the print goes on without its heat; `bed` with a "
        "temperature heats it again";
  }
  if (trouble) rest();
  return trouble;
}

void HeatWatch::rest() {
  nozzle_.rest();
  bed_.rest();
}

std::optional<std::string> WarmUpWatch::note(TimePoint at, const gcode::Temperatures& reported, double nozzle,
                                             double bed) {
  constexpr double rise = 2;     // °C that count as warmer
  constexpr double nearly = 15;  // °C; so close to its target a heater may take its time
  constexpr auto nozzle_may_take = 90s;
  constexpr auto bed_may_take = 300s;
  std::optional<std::string> trouble;
  const auto look = [&](std::optional<Climb>& climb, const char* name, std::optional<double> reading,
                        double target, std::chrono::seconds may_take) {
    if (!reading || target <= 0 || *reading >= target - nearly) return climb.reset();
    if (!climb || climb->target != target || *reading >= climb->highest + rise) {
      climb = Climb{target, *reading, at};
    } else if (at - climb->since >= may_take && !trouble) {
      trouble = fmt::format(
          "the {} has not become warmer than {:.0f} °C for {} s, although it should have {:.0f} °C: its "
          "heater "
          "or sensor may have failed; check them before you print again",
          name, std::max(climb->highest, *reading), may_take.count(), target);
    }
  };
  // The line that heats the nozzle may be waiting behind the one that waits for the bed.
  const bool bed_first = reported.bed && *reported.bed < bed - nearly;
  look(nozzle_, "nozzle", reported.nozzle, reported.nozzle_target.value_or(bed_first ? 0 : nozzle),
       nozzle_may_take);
  look(bed_, "bed", reported.bed, reported.bed_target.value_or(bed), bed_may_take);
  return trouble;
}

}  // namespace unicursal::host
