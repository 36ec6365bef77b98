#include "host/engine/heat_forecast.hpp"

#include <algorithm>

#include "host/engine/seconds.hpp"

namespace unicursal::host {
namespace {

constexpr double window = 15;         ///< s of reports that the rate is taken from
constexpr double shortest = 4;        ///< s of reports that show a rate
constexpr double near = 2;            ///< °C below the target, where firmwares begin to call it reached
constexpr double usual_nozzle = 2.5;  ///< °C/s, a cartridge of 40 W
constexpr double usual_bed = 0.4;     ///< °C/s, a bed of 200 × 200 mm with 120 W
constexpr double slowest = 0.1;       ///< of the usual rate; a heater that rises more slowly has just begun

bool is_on(const std::optional<double>& reported_target, double target) {
  return !reported_target || *reported_target >= target - 1;
}

}  // namespace

void HeaterForecast::note(TimePoint at, double reading) {
  marks_.push_back({at, reading});
  while (seconds(at - marks_.front().at) > window) marks_.pop_front();
}

double HeaterForecast::left(double target) const {
  if (marks_.empty()) return 0;
  const Mark &first = marks_.front(), &last = marks_.back();
  const double missing = target - near - last.reading;
  if (missing <= 0) return 0;
  double rate = usual_rate_;
  const double passed = seconds(last.at - first.at);
  const double risen = last.reading - first.reading;
  if (passed >= shortest && risen > slowest * usual_rate_ * passed) rate = risen / passed;
  return missing / rate;
}

HeatForecast::HeatForecast() : nozzle_(usual_nozzle), bed_(usual_bed) {}

void HeatForecast::note(TimePoint at, const gcode::Temperatures& reported) {
  last_ = reported;
  if (reported.nozzle) nozzle_.note(at, *reported.nozzle);
  if (reported.bed) bed_.note(at, *reported.bed);
}

double HeatForecast::left(double nozzle, double bed) const {
  const double nozzle_left = nozzle_.left(nozzle), bed_left = bed_.left(bed);
  const bool side_by_side = is_on(last_.nozzle_target, nozzle) && is_on(last_.bed_target, bed);
  return side_by_side ? std::max(nozzle_left, bed_left) : nozzle_left + bed_left;
}

}  // namespace unicursal::host
