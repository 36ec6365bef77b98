#include "sim/firmware/heater.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

namespace {

/// Runs the control until the first alarm.
std::optional<Heater::Alarm> run(Heater& heater, double& now, double until) {
  for (auto next = heater.next_tick(); next && *next <= until; next = heater.next_tick()) {
    now = *next;
    if (const auto alarm = heater.tick(now)) return alarm;
  }
  now = until;
  return std::nullopt;
}

std::string last_words(const std::string& fault_of, void (*fault)(Heater&, double)) {
  Bench bench;
  bench.heat();
  Heater& heater = fault_of == "bed" ? bench.firmware.bed() : bench.firmware.nozzle();
  if (fault_of == "bed") bench.finish("M190 S60");
  bench.replies.clear();
  fault(heater, bench.firmware.now());
  bench.firmware.advance(bench.firmware.now() + 600);
  CHECK(bench.firmware.killed());
  REQUIRE(bench.replies.size() == 3);
  CHECK(bench.replies[1] == "Error:Printer halted. kill() called!");
  CHECK(bench.firmware.nozzle().target() == 0);
  const std::string words = bench.replies.front();
  CHECK(bench.send("M105").empty());
  return words;
}

}  // namespace

TEST_CASE("at full power the block follows its exponential, and the sensor lags behind") {
  HeaterModel model;
  Heater heater(model);
  heater.set_target(0, 260);
  CHECK(heater.power() == 127);
  const double end = 425, start = 25, time = 30;
  CHECK(heater.block(time) == Approx(end + (start - end) * std::exp(-time / model.time_constant)));
  const double ramp = (end - start) / model.time_constant;
  CHECK(heater.temperature(time) < heater.block(time));
  CHECK(heater.block(time) - heater.temperature(time) < ramp * model.sensor_lag);
  const double step = 1e-4;  // the lag's equation, by finite differences
  const double slope = (heater.temperature(time + step) - heater.temperature(time - step)) / (2 * step);
  CHECK(slope == Approx((heater.block(time) - heater.temperature(time)) / model.sensor_lag).epsilon(1e-6));
}

TEST_CASE("nozzle and bed reach their targets and stay there, with little overshoot") {
  const auto [model, target] = GENERATE(table<HeaterModel, double>({{HeaterModel{}, 210.0},
                                                                    {HeaterModel{}, 260.0},
                                                                    {HeaterModel::bed(), 60.0},
                                                                    {HeaterModel::bed(), 110.0}}));
  Heater heater(model);
  double now = 0, highest = 0;
  heater.set_target(now, target);
  for (int second = 1; second <= 1200; ++second) {
    REQUIRE_FALSE(run(heater, now, second));
    highest = std::max(highest, heater.temperature(now));
    if (second > 600) CHECK(heater.temperature(now) == Approx(target).margin(1));
  }
  CHECK(highest < target + 4);
  CHECK(heater.power() > 0);
  CHECK(heater.power() < 127);
}

TEST_CASE("an unheated nozzle cools to room temperature, and has no events") {
  Heater heater{HeaterModel{}};
  double now = 0;
  heater.set_target(0, 200);
  run(heater, now, 300);
  heater.set_target(now, 0);
  CHECK_FALSE(heater.next_tick());
  CHECK(heater.temperature(now + 3600) == Approx(25).margin(0.01));
}

TEST_CASE("targets above the firmware's limit are lowered to it") {
  Heater heater{HeaterModel{}};
  heater.set_target(0, 900);
  CHECK(heater.target() == 260);
  heater.set_target(0, -5);
  CHECK(heater.target() == 0);
}

TEST_CASE("a cartridge without heat is a thermal runaway when hot, and failed heating when cold") {
  CHECK(last_words("nozzle", [](Heater& heater, double now) {
          heater.break_down(now, Heater::Defect::open);
        }) == "Error:Thermal Runaway, system stopped! Heater_ID: 0");
  Bench bench;
  bench.firmware.nozzle().break_down(0, Heater::Defect::open);
  bench.send("M109 S200");
  bench.firmware.advance(60);
  CHECK(std::find(bench.replies.begin(), bench.replies.end(),
                  "Error:Heating failed, system stopped! Heater_ID: 0") != bench.replies.end());
}

TEST_CASE("the alarm of a bed without heat names the bed") {
  CHECK(last_words("bed", [](Heater& heater, double now) { heater.break_down(now, Heater::Defect::open); }) ==
        "Error:Thermal Runaway, system stopped! Heater_ID: bed");
}

TEST_CASE(
    "a heater that cannot be switched off raises the alarm at the highest temperature, and keeps heating") {
  CHECK(last_words("nozzle", [](Heater& heater, double now) {
          heater.break_down(now, Heater::Defect::closed);
        }) == "Error:MAXTEMP triggered, system stopped! Heater_ID: 0");
  Heater heater{HeaterModel{}};
  heater.break_down(0, Heater::Defect::closed);
  CHECK(heater.block(1000) > 400);
}

TEST_CASE("a thermistor that falls out is noticed at once") {
  CHECK(last_words("nozzle", [](Heater& heater, double now) { heater.pull_thermistor(now); }) ==
        "Error:MINTEMP triggered, system stopped! Heater_ID: 0");
}

TEST_CASE("a working heater raises no alarm through a day of changes") {
  Heater heater{HeaterModel{}};
  double now = 0;
  for (const double target : {200.0, 240.0, 180.0, 0.0, 210.0, 215.0, 190.0, 260.0}) {
    heater.set_target(now, target);
    CHECK_FALSE(run(heater, now, now + 10000));
  }
}

TEST_CASE("a working heater raises no alarm, however near to its new target it starts") {
  const auto [model, highest] =
      GENERATE(table<HeaterModel, double>({{HeaterModel{}, 260.0}, {HeaterModel::bed(), 110.0}}));
  for (double target = 40; target <= highest; target += 10) {
    for (double away = -12; away <= 12; away += 0.5) {
      Heater heater(model);
      double now = 0;
      // It cools after a reset of the board, for a time that depends on the host, and is heated again.
      heater.set_target(now, std::min(target + away, highest));
      REQUIRE_FALSE(run(heater, now, 2000));
      heater.reset(now);
      now += 1;
      heater.set_target(now, target);
      CAPTURE(target, away);
      CHECK_FALSE(run(heater, now, now + 600));
      heater.set_target(now, target);  // the same target again, as each resumed print sends it
      CHECK_FALSE(run(heater, now, now + 600));
    }
  }
}
