// A heater that fails in mid-print, as a session sees it.
#include "host/engine/heat_watch.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "host/engine/seconds.hpp"
#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::test::replaced;
using unicursal::test::SampleFiles;
using unicursal::test::SessionBench;

namespace {

constexpr HeaterWatch::Rules rules{15, 8, 0.8, 15};

/// s after which the watch has an objection to a course of the temperature, reported every 2 s; −1: never.
double objects_at(const std::function<double(double)>& reading, double wanted = 210,
                  std::optional<double> reported = std::nullopt,
                  std::optional<HeatTrouble> what = std::nullopt) {
  HeaterWatch watch(rules);
  for (double t = 0; t < 300; t += 2) {
    const auto trouble = watch.note(TimePoint(duration(t)), reading(t), reported, wanted);
    if (!trouble) continue;
    if (what) CHECK(*trouble == *what);
    return t;
  }
  return -1;
}

/// Long enough for a fault in its middle.
SampleFiles tall(const std::string& firmware) {
  SampleFiles sample;
  if (firmware == "repetier") sample.profile = replaced(sample.profile, "\"marlin\"", "\"repetier\"");
  sample.job = replaced(unicursal::test::sample_job, "height = 0.4", "height = 2.4");
  return sample;
}

struct Watched {
  StreamResult result;
  double paused_after = -1;  ///< s from the fault to the pause; −1: never paused
  std::string why;
  std::vector<std::string> lines;
  bool killed = false, cold = false;
};

constexpr double fault_at = 180;  ///< s; it prints by then

Watched print_with(const std::string& firmware, const std::vector<std::string>& faults,
                   const std::function<void(Session&)>& when_paused) {
  std::vector<std::string> options{"--personality", firmware};
  for (const std::string& fault : faults) options.insert(options.end(), {"--fault", fault + "@t=180"});
  SessionBench bench(options, "", tall(firmware));
  bench.settings.link.temperatures = std::chrono::seconds(1);
  Watched seen;
  seen.result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind != SessionEvent::Kind::state || status.state != SessionState::paused) return;
    if (seen.why.empty()) seen.why = status.reason, seen.paused_after = status.elapsed - fault_at;
    when_paused(session);
  });
  seen.lines = bench.executed();
  seen.killed = bench.seen()["killed"];
  seen.cold = bench.cold();
  return seen;
}

}  // namespace

TEST_CASE("A heater that gives no more heat is noticed within 10 s, and one that only dips is left alone") {
  // A block of 120 s, as a common hot end's.
  CHECK(objects_at([](double t) { return 25 + 185 * std::exp(-t / 120); }, 210, 210, HeatTrouble::cold) ==
        Approx(6).margin(4));
  // The part's fan has been switched on: 10 °C in half a minute, then back.
  CHECK(objects_at([](double t) { return 210 - 10 * std::sin(std::min(t, 60.0) / 60 * 3.14159); }) == -1);
  // It has not been as hot as it should be since the beginning.
  CHECK(objects_at([](double) { return 150.0; }) == -1);
  // It stays a little too cold, and far too cold.
  CHECK(objects_at([](double t) { return t < 10 ? 210.0 : 196.0; }) == -1);
  CHECK(objects_at([](double t) { return t < 10 ? 210.0 : 194.0; }, 210, 210, HeatTrouble::cold) == 20);
  // One report is damaged.
  CHECK(objects_at([](double t) { return t == 20 ? 5.0 : 210.0; }) == -1);
  CHECK(objects_at([](double t) { return t == 20 ? 999.0 : 210.0; }) == -1);
  CHECK(objects_at([](double t) { return t == 20 ? 21.0 : t < 20 ? 210.2 - t / 100 : 210.0; }) == -1);
}

TEST_CASE(
    "A heater that does not become warmer is noticed while it is waited for, a slow one is left alone") {
  const auto objects_at = [](const std::function<unicursal::gcode::Temperatures(double)>& reading,
                             double wanted = 210) {
    WarmUpWatch watch;
    for (double t = 0; t < 1800; t += 2) {
      if (const auto trouble = watch.note(TimePoint(duration(t)), reading(t), wanted, 60)) return t;
    }
    return -1.0;
  };
  using Heat = unicursal::gcode::Temperatures;
  const auto nozzle = [](double reading, double target) {
    Heat heat;
    heat.nozzle = reading, heat.nozzle_target = target;
    return heat;
  };
  const auto bed = [](double reading, double target) {
    Heat heat;
    heat.bed = reading, heat.bed_target = target;
    return heat;
  };
  CHECK(objects_at([&](double) { return nozzle(24, 210); }) == 90);
  CHECK(objects_at([&](double t) { return nozzle(std::min(120.0, 24 + t), 210); }) == 96 + 90);
  CHECK(objects_at([&](double t) { return nozzle(std::min(210.0, 24 + 0.05 * t), 210); }) == -1);
  CHECK(objects_at([&](double) { return nozzle(198, 210); }) == -1);  // it oscillates near its target
  CHECK(objects_at([&](double) { return nozzle(24, 0); }) == -1);     // its line waits behind the bed's
  CHECK(objects_at([&](double t) { return nozzle(24 + std::fmod(t, 4), t < 60 ? 0 : 210); }) == 60 + 92);
  CHECK(objects_at([&](double) { return bed(21, 60); }) == 300);
  const auto silent_about_targets = [](double nozzle_reading, double bed_reading) {
    Heat heat;
    heat.nozzle = nozzle_reading, heat.bed = bed_reading;
    return heat;
  };
  CHECK(objects_at([&](double) { return silent_about_targets(24, 60); }) == 90);
  CHECK(objects_at([&](double) { return silent_about_targets(24, 60); }, 0) == -1);
  CHECK(objects_at([&](double t) { return silent_about_targets(24, std::min(60.0, 20 + t / 10)); }) ==
        250 + 90);
  CHECK(objects_at([&](double t) { return bed(std::min(60.0, 21 + 0.01 * t), 60); }) == -1);
}

TEST_CASE(
    "A print whose nozzle never becomes warm fails and is cold, also if the firmware waits without end") {
  const std::string firmware = GENERATE("marlin", "marlin-8bit", "marlin-host", "repetier", "reprapfirmware");
  CAPTURE(firmware);
  SampleFiles sample = tall(firmware);
  if (firmware == "reprapfirmware")
    sample.profile = replaced(sample.profile, "\"marlin\"", "\"reprapfirmware\"");
  SessionBench bench({"--personality", firmware, "--fault", "unguarded@t=0", "--fault", "heaterfail@t=0"}, "",
                     sample);
  const StreamResult result = bench.print();
  CAPTURE(result.reason, bench.executed(), bench.seen()["temperatures"].dump());
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find("the nozzle has not become warmer than") != std::string::npos);
  // Without an emergency parser a firmware reads nothing while it waits, and this port has no line that
  // resets.
  CHECK((bench.cold() || result.reason.find("switch it off by its own switch") != std::string::npos));
  CHECK((bench.cold() || firmware != "marlin-host"));
}

TEST_CASE("A heater that becomes hotter and hotter is noticed, and one that cools to a new target is not") {
  CHECK(objects_at([](double t) { return 210 + t; }, 210, 210, HeatTrouble::hot) == 26);
  CHECK(objects_at([](double t) { return std::max(195.0, 240 - t / 2); }, 195) == -1);
  // It cools by 1 °C/s, and then somewhat below its target, as under a control that has to find its power
  // again.
  CHECK(objects_at([](double t) { return t < 20 ? 210 - t : std::max(181.0, 190 - 0.64 * (t - 20)); }, 190) ==
        -1);
}

TEST_CASE(
    "A target that the firmware has lost is noticed at once, one that was set at its display is respected") {
  HeaterWatch watch(rules);
  const auto at = [](double t) { return TimePoint(duration(t)); };
  CHECK_FALSE(watch.note(at(0), 25, 0, 210));  // the line that sets it is still on its way
  CHECK_FALSE(watch.note(at(2), 25, 0, 210));
  CHECK_FALSE(watch.note(at(4), 30, 210, 210));
  CHECK_FALSE(watch.note(at(6), 30, 0, 210));
  CHECK(watch.note(at(8), 30, 0, 210) == HeatTrouble::off);
  watch.rest();
  CHECK_FALSE(watch.note(at(0), 210, 210, 210));
  for (double t = 2; t < 100; t += 2) CHECK_FALSE(watch.note(at(t), std::max(180.0, 210 - t), 180, 210));
}

TEST_CASE(
    "A nozzle that dies in mid-print is taken off the part, and the print fails or goes on when it is hot") {
  const std::string firmware = GENERATE("marlin", "marlin-8bit", "repetier");
  const bool noticed = GENERATE(true, false);
  CAPTURE(firmware, noticed);
  std::vector<std::string> faults{"heaterfail"};
  if (!noticed) faults.emplace_back("unguarded");
  const Watched seen = print_with(firmware, faults, [&](Session& session) {
    if (!noticed) CHECK_FALSE(session.cancel());
  });
  CHECK(seen.paused_after > 0);
  CHECK(seen.paused_after <= 10);
  CHECK(seen.why.find("nozzle has fallen to") != std::string::npos);
  CHECK(seen.result.ending == (noticed ? Ending::failed : Ending::stopped));
  CHECK((seen.killed || seen.cold));
  const auto aside = std::find_if(seen.lines.begin(), seen.lines.end(),
                                  [](const auto& line) { return line.starts_with("G0 X5 Y5"); });
  CHECK(aside != seen.lines.end());
}

TEST_CASE("A bed that dies in mid-print holds the print, too") {
  const Watched seen = print_with("marlin", {"bedfail", "unguarded"}, [](Session& s) { s.cancel(); });
  CHECK(seen.why.find("bed has fallen to") != std::string::npos);
  CHECK(seen.result.ending == Ending::stopped);
}

TEST_CASE("A nozzle that cannot be switched off holds the print, and the firmware ends it") {
  const Watched noticed = print_with("marlin", {"runaway"}, [](Session&) {});
  CHECK(noticed.why.find("becomes hotter") != std::string::npos);
  CHECK(noticed.result.ending == Ending::failed);
  CHECK(noticed.result.reason.find("MAXTEMP") != std::string::npos);
  const Watched unnoticed = print_with("marlin", {"runaway", "unguarded"}, [](Session& s) { s.cancel(); });
  CHECK(unnoticed.why.find("becomes hotter") != std::string::npos);
  CHECK(unnoticed.result.ending == Ending::failed);
  CHECK(unnoticed.result.reason.find("although its heater was switched off") != std::string::npos);
}

TEST_CASE(
    "A bed that is switched off at the printer's display is mentioned, and the print goes on without it") {
  const auto at = [](double t) { return TimePoint(duration(t)); };
  HeatWatch watch;
  unicursal::gcode::Temperatures now;
  now.nozzle = now.nozzle_target = 210, now.bed = now.bed_target = 60;
  CHECK_FALSE(watch.note(at(0), now, 210, 60));
  now.bed_target = 0;
  CHECK_FALSE(watch.note(at(2), now, 210, 60));
  const auto trouble = watch.note(at(4), now, 210, 60);
  REQUIRE(trouble);
  CHECK(trouble->meant);
  for (double t = 6; t < 100; t += 2) {
    now.bed = 60 - t / 2;
    CHECK_FALSE(watch.note(at(t), now, 210, 0));
  }
  // A firmware that switches both off has a reason.
  HeatWatch other;
  now.nozzle = now.nozzle_target = 210, now.bed = now.bed_target = 60;
  CHECK_FALSE(other.note(at(0), now, 210, 60));
  now.nozzle_target = now.bed_target = 0;
  CHECK_FALSE(other.note(at(2), now, 210, 60));
  REQUIRE(other.note(at(4), now, 210, 60));
  CHECK_FALSE(HeatWatch().note(at(4), now, 210, 60));
  HeatWatch third;
  now.nozzle_target = 210, now.bed_target = 60;
  third.note(at(0), now, 210, 60);
  now.nozzle_target = now.bed_target = 0;
  third.note(at(2), now, 210, 60);
  CHECK_FALSE(third.note(at(4), now, 210, 60)->meant);
}

TEST_CASE("A print whose bed is switched off at the display is completed with a warning, without its heat") {
  SessionBench bench({"--fault", "display:M140 S0@t=180"}, "", tall("marlin"));
  bench.settings.link.temperatures = std::chrono::seconds(2);
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 0);
  const auto& warnings = bench.last().warnings;
  const auto mentions = [](const std::string& one) {
    return one.find("switched off at the printer") != std::string::npos;
  };
  CHECK(std::count_if(warnings.begin(), warnings.end(), mentions) == 1);
}

TEST_CASE("A heater that sticks when it is switched off fails the print, also if the part is done") {
  const std::string firmware = GENERATE("marlin", "repetier", "repetier-0.92");
  // At this line the last layer is laid; the firmware does not look at a heater that is off.
  SampleFiles sample;
  if (firmware != "marlin") sample.profile = replaced(sample.profile, "\"marlin\"", "\"repetier\"");
  SessionBench bench(
      {"--personality", firmware, "--fault", "runaway@command=M107", "--fault", "unguarded@t=1"}, "", sample);
  bench.settings.link.temperatures = std::chrono::seconds(1);
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find("although its heater was switched off") != std::string::npos);
  CHECK(result.parked);
}
