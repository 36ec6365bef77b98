// A print that is steered while it runs, in virtual time, on a simulated printer.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "host/engine/session_json.hpp"
#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::test::SessionBench;
using Kind = SessionEvent::Kind;
using Lines = std::vector<std::string>;

namespace {

/// Acts once, when the print has reached `percent`.
SessionBench::Script at(double percent, const std::function<void(Session&)>& act) {
  return [percent, act, done = false](Session& session, const SessionEvent& event) mutable {
    if (done || event.kind != Kind::progress || session.status().percent < percent) return;
    done = true;
    act(session);
  };
}

/// Pauses at `percent`, and resumes as soon as the print is held.
SessionBench::Script held_at(double percent) {
  return [inner = at(percent, [](Session& s) { CHECK_FALSE(s.pause()); })](
             Session& session, const SessionEvent& event) mutable {
    inner(session, event);
    if (event.kind == Kind::state && session.status().state == SessionState::paused)
      CHECK_FALSE(session.resume());
  };
}

Lines undisturbed() {
  SessionBench bench;
  REQUIRE(bench.print().ending == Ending::completed);
  return bench.executed();
}

/// The lines that `more` has in addition to `lines`, which must be in it whole, in at most two pieces.
Lines inserted(const Lines& lines, const Lines& more) {
  REQUIRE(more.size() >= lines.size());
  const auto [a, b] = std::mismatch(lines.begin(), lines.end(), more.begin());
  const auto rest = lines.end() - a;
  REQUIRE(std::equal(a, lines.end(), more.end() - rest));
  return {b, more.end() - rest};
}

bool holds(const Lines& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

std::size_t index_of(const Lines& lines, const std::string& line) {
  return static_cast<std::size_t>(std::find(lines.begin(), lines.end(), line) - lines.begin());
}

}  // namespace

TEST_CASE("A print that was paused runs every line once, in order") {
  const Lines plain = undisturbed();
  SessionBench bench;
  const StreamResult result = bench.print(held_at(40));
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 1);
  const Lines pause = inserted(plain, bench.executed());
  CHECK(holds(pause, "M400"));
  CHECK(holds(pause, "G1 E-4 F1500"));
  CHECK_FALSE(holds(pause, "M104 S0"));
  CHECK(bench.cold());
}

TEST_CASE("A held printer stands aside, above the part, and returns to where it was") {
  SessionBench bench;
  REQUIRE(bench.print(held_at(40)).ending == Ending::completed);
  const Lines lines = bench.executed();
  const std::size_t still = index_of(lines, "M400");
  REQUIRE(still < lines.size());
  // The part lies at 50…70 × 42…58 mm on a bed of 120 × 100.
  CHECK(lines[still - 1].rfind("G0 X5 Y5", 0) == 0);
  const auto is_travel = [](const std::string& line) { return line.rfind("G0 X", 0) == 0; };
  const auto there = std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(still), lines.end(), is_travel);
  REQUIRE(there != lines.end());
  const std::string back = there->substr(3, there->find(" F") - 3);
  const auto came_from = [&](const std::string& line) { return line.find(back + " ") != std::string::npos; };
  CHECK(std::any_of(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(still), came_from));
}

TEST_CASE("A nozzle whose heat was lowered is hot again before the print goes on") {
  SessionBench bench;
  bench.settings.pause_heat = PauseHeat::lower;
  REQUIRE(bench.print(held_at(40)).ending == Ending::completed);
  const Lines lines = bench.executed();
  const std::size_t lower = index_of(lines, "M104 S150"), still = index_of(lines, "M400");
  REQUIRE(lower < still);
  const auto hot = std::find(lines.begin() + static_cast<std::ptrdiff_t>(still), lines.end(), "M109 S210");
  REQUIRE(hot != lines.end());
  CHECK(std::any_of(hot, lines.end(), [](const auto& l) { return l.rfind("G1 X", 0) == 0; }));
}

TEST_CASE("A long pause keeps the firmware's watch on this program fresh") {
  SessionBench bench;
  bench.settings.longest_pause = 4000;  // s; M85 switches an idle printer off after 1800
  REQUIRE(bench.print(at(40, [](Session& s) { CHECK_FALSE(s.pause()); })).ending == Ending::completed);
  CHECK(bench.seen()["killed"] == false);
  CHECK(bench.seen()["printer_seconds"].get<double>() > 4000);
}

TEST_CASE("A pause that nobody ends cools the nozzle, and heats it again before the print goes on") {
  SessionBench bench;
  bench.settings.longest_pause = 1200;  // s
  REQUIRE(bench.print(at(40, [](Session& s) { CHECK_FALSE(s.pause()); })).ending == Ending::completed);
  const Lines lines = bench.executed();
  const std::size_t still = index_of(lines, "M400"), cool = index_of(lines, "M104 S150");
  REQUIRE(still < cool);
  REQUIRE(cool < lines.size());
  CHECK(std::count(lines.begin(), lines.end(), "M104 S150") == 1);
  const auto from = lines.begin() + static_cast<std::ptrdiff_t>(still);
  const auto to = lines.begin() + static_cast<std::ptrdiff_t>(cool);
  CHECK(std::find(to, lines.end(), "M109 S210") != lines.end());
  CHECK(std::count(from, to, "M85 S1800") >= 80);  // a quarter of an hour
}

TEST_CASE("A nozzle that waits for planning does not stay on the part, and the firmware does not give up") {
  SessionBench bench(
      {}, "", {unicursal::test::replaced(unicursal::test::sample_job, "height = 0.4", "height = 1.2")});
  bench.charge = 2e4;  // every layer is many minutes late
  std::vector<std::string> whys;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state || session.status().state != SessionState::paused) return;
    whys.push_back(session.status().reason);
    CHECK(session.resume().value().find("waiting") != std::string::npos);
  });
  REQUIRE(result.ending == Ending::completed);
  CHECK(result.waited > 60);
  REQUIRE(!whys.empty());
  CHECK(whys.front().find("planning") != std::string::npos);
  CHECK(result.pauses == whys.size());
  CHECK(bench.seen()["killed"] == false);
  const Lines lines = bench.executed();
  const std::size_t first = index_of(lines, "M400");
  REQUIRE(first < lines.size());
  CHECK(lines[first - 1].rfind("G0 X5 Y5", 0) == 0);
  const auto laid = [](const std::string& line) { return line.rfind("G1 X", 0) == 0; };
  CHECK(std::any_of(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first), laid));
  CHECK(std::count(lines.begin(), lines.end(), "M400") == static_cast<std::ptrdiff_t>(whys.size()));
}

TEST_CASE("A pause asked for while the nozzle stands aside lasts until the user ends it") {
  SessionBench bench(
      {}, "", {unicursal::test::replaced(unicursal::test::sample_job, "height = 0.4", "height = 1.2")});
  bench.charge = 2e4;
  bench.settings.link.temperatures = std::chrono::seconds(2);  // so that there are events meanwhile
  int holds = 0, returns = 0;
  double since = 0;
  bool asked = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionState state = session.status().state;
    if (event.kind == Kind::state && state == SessionState::resuming) ++returns;
    if (event.kind == Kind::state && state == SessionState::paused && holds++ == 0) {
      since = session.status().elapsed;
      CHECK_FALSE(session.pause());
      CHECK(session.pause().value() == "it is paused already");
    }
    // Long after the layer was planned:
    if (!asked && event.kind == Kind::heat && holds > 0 && session.status().elapsed > since + 6000) {
      asked = true;
      CHECK(state == SessionState::paused);
      CHECK(returns == 0);
      CHECK_FALSE(session.resume());
    }
  });
  CHECK(asked);
  CHECK(returns > 0);
  CHECK(result.ending == Ending::completed);
}

TEST_CASE("A nozzle that is too cold to lay anything holds the print") {
  const std::string words = GENERATE("echo: cold extrusion prevented", "Error: cold extrusion prevented");
  SessionBench bench({"--fault", "say:" + words + "@line=200"});
  const Lines plain = undisturbed();
  std::string why;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state || session.status().state != SessionState::paused) return;
    why = session.status().reason;
    CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  CHECK(why.find("too cold") != std::string::npos);
  CHECK(holds(inserted(plain, bench.executed()), "M109 S210"));
}

TEST_CASE("A printer that has stopped itself fails the print at once, with its words") {
  const auto [fault, words] = GENERATE(table<std::string, std::string>({
      {"stopped@line=200", "use M999 to restart"},
      {"say:Error:Printer set into dry run mode until restart!@line=200", "dry run mode"},
      {"say:Printer stopped due to errors. Use M999@line=200", "stopped due to errors"},
      {"say:!! STOP called because of BLTouch error@line=200", "STOP called"},
      {"say:Error:0: Extruder switched off. MINTEMP triggered !@line=200", "MINTEMP"},
  }));
  CAPTURE(fault);
  SessionBench bench({"--fault", fault});
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::failed);
  CHECK(result.begun);
  CHECK_FALSE(result.parked);
  CHECK(result.reason.find(words) != std::string::npos);
  CHECK(bench.cold());
  CHECK(bench.executed().size() < 300);
}

TEST_CASE("A printer that refuses moves, or has too few tools, fails the print at once and is cold") {
  const std::string words = GENERATE("Home XYZ First", "Home Z First", "T2 Invalid extruder");
  CAPTURE(words);
  SessionBench bench({"--fault", "say:echo:" + words + "@line=200"});
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find(words) != std::string::npos);
  CHECK(bench.cold());
  CHECK(bench.executed().size() < 300);
}

TEST_CASE("A probing that has failed and is repeated does not end the print") {
  SessionBench bench({"--fault", "say:Error:Probing Failed@line=200"});
  CHECK(bench.print().ending == Ending::completed);
}

TEST_CASE("A pause may be asked for at any time before the end, while heating as well") {
  const Lines plain = undisturbed();
  const SessionState when = GENERATE(SessionState::connecting, SessionState::heating);
  SessionBench bench;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionState state = session.status().state;
    if (event.kind == Kind::state && state == when) CHECK_FALSE(session.pause());
    if (event.kind == Kind::heat && when == SessionState::connecting && state == when) session.pause();
    if (event.kind == Kind::state && state == SessionState::paused) CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  const Lines more = bench.executed();
  CHECK(more.size() >= plain.size());
  CHECK(bench.seen()["executed_lines_in_order"] == true);
}

TEST_CASE("The session obeys the firmware as it obeys the user") {
  const Lines plain = undisturbed();
  SECTION("pause and resume") {
    SessionBench bench(
        {"--fault", "say://action:pause@line=200", "--fault", "say://action:resume@command=M85"});
    CHECK(bench.print().pauses == 1);
    CHECK(holds(inserted(plain, bench.executed()), "M400"));
  }
  SECTION("pause and resume in Repetier's words") {
    SessionBench bench(
        {"--fault", "say:RequestPause:Extruder jam@line=200", "--fault", "say:RequestContinue:@command=M85"});
    std::string why;
    const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
      if (event.kind == Kind::state && session.status().state == SessionState::paused)
        why = session.status().reason;
    });
    CHECK(result.pauses == 1);
    CHECK(result.ending == Ending::completed);
    CHECK(why.find("Extruder jam") != std::string::npos);
  }
  SECTION("the end in Repetier's words, and with a space") {
    const std::string words = GENERATE("RequestStop:", "// action:cancel");
    SessionBench bench({"--fault", "say:" + words + "@line=200"});
    CHECK(bench.print().ending == Ending::stopped);
    CHECK(bench.cold());
  }
  SECTION("cancel") {
    SessionBench bench({"--fault", "say://action:cancel@line=200"});
    const StreamResult result = bench.print();
    CHECK(result.ending == Ending::stopped);
    CHECK(result.parked);
    CHECK(bench.cold());
    CHECK(bench.last().reason.find("printer") != std::string::npos);
  }
}

TEST_CASE("A cancelled print is parked and cold, from wherever it is") {
  const SessionState when = GENERATE(SessionState::heating, SessionState::printing, SessionState::pausing,
                                     SessionState::paused, SessionState::resuming);
  CAPTURE(name(when));
  SessionBench bench;
  const auto pause = at(40, [](Session& s) { s.pause(); });
  const StreamResult result = bench.print([&, pause](Session& session, const SessionEvent& event) mutable {
    const SessionState state = session.status().state;
    if (when != SessionState::printing) pause(session, event);
    if (when == SessionState::printing && session.status().percent > 40 && state == when) session.cancel();
    if (event.kind != Kind::state) return;
    if (state == when && when != SessionState::printing) CHECK_FALSE(session.cancel());
    if (state == SessionState::paused && when == SessionState::resuming) session.resume();
  });
  CHECK(result.ending == Ending::stopped);
  CHECK(bench.last().state == SessionState::stopped);
  CHECK(bench.cold());
  CHECK(result.parked == (when != SessionState::heating));
}

TEST_CASE("An emergency stop ends everything at once, and is confirmed") {
  SessionBench bench;
  const StreamResult result = bench.print(at(40, [](Session& s) { CHECK_FALSE(s.emergency_stop()); }));
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find("stopped at once; reset the printer") != std::string::npos);
  CHECK(bench.seen()["killed"] == true);
  CHECK(bench.cold());
}

TEST_CASE("An emergency stop ends a pause at once") {
  SessionBench bench;
  double asked = 0;
  const auto pause = at(40, [](Session& s) { CHECK_FALSE(s.pause()); });
  const StreamResult result = bench.print([&, pause](Session& session, const SessionEvent& event) mutable {
    pause(session, event);
    if (event.kind != Kind::state || session.status().state != SessionState::paused) return;
    asked = session.status().elapsed;
    CHECK_FALSE(session.emergency_stop());
  });
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find("stopped at once; reset the printer") != std::string::npos);
  CHECK(asked > 0);
  CHECK(bench.last().elapsed - asked < 3);  // s
  CHECK(bench.seen()["killed"] == true);
}

TEST_CASE("Speed, flow and heat change while it prints, and nothing else does") {
  const Lines plain = undisturbed();
  SessionBench bench;
  bool refused = false;
  const StreamResult result = bench.print(at(40, [&](Session& session) {
    CHECK_FALSE(session.set_speed(80));
    CHECK_FALSE(session.set_flow(95));
    CHECK_FALSE(session.set_nozzle(205));
    CHECK_FALSE(session.set_bed(55));
    refused = session.set_speed(5) && session.set_flow(1e9) && session.set_nozzle(900) &&
              session.set_bed(-1) && session.set_speed(std::nan(""));
  }));
  CHECK(refused);
  CHECK(result.ending == Ending::completed);
  CHECK(inserted(plain, bench.executed()) == Lines{"M220 S80", "M221 S95", "M104 S205", "M140 S55"});
  CHECK(bench.last().speed_percent == 80);
  CHECK(bench.last().flow_percent == 95);
  CHECK(bench.cold());
}

TEST_CASE("Heat that was changed is what a pause comes back to") {
  SessionBench bench;
  bench.settings.pause_heat = PauseHeat::lower;
  const auto hold = held_at(50);
  const auto change = at(30, [](Session& s) { s.set_nozzle(195); });
  REQUIRE(bench
              .print([hold, change](Session& session, const SessionEvent& event) mutable {
                change(session, event);
                hold(session, event);
              })
              .ending == Ending::completed);
  CHECK(holds(bench.executed(), "M104 S135"));
  CHECK(holds(bench.executed(), "M109 S195"));
}

TEST_CASE("Commands that do not fit the state are refused with a reason") {
  SessionBench bench;
  bool seen = false;
  bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state) return;
    switch (session.status().state) {
      case SessionState::printing:
        seen = true;
        CHECK(session.resume().value() == "it is not paused");
        break;
      case SessionState::finishing:
        CHECK(session.pause());
        CHECK(session.cancel());
        CHECK(session.set_speed(90));
        break;
      case SessionState::done:
        CHECK(session.pause());
        CHECK(session.resume());
        CHECK(session.cancel());
        CHECK(session.emergency_stop());
        break;
      default:
        break;
    }
  });
  CHECK(seen);
}

TEST_CASE("Events and status agree with one another throughout a print") {
  SessionBench bench;
  std::set<std::string> mixtures;
  std::vector<SessionState> states;
  double percent = 0, left = 1e9;
  std::size_t layer = 0;
  bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind == Kind::state) states.push_back(status.state);
    CHECK(status.layers == 2);
    CHECK(status.layer <= 2);
    CHECK(status.layer >= layer);
    layer = status.layer;
    if (!status.mixture.empty()) mixtures.insert(status.mixture);
    if (status.state != SessionState::printing || !status.left) return;
    CHECK(status.percent >= percent - 1e-9);
    CHECK(*status.left <= left * 1.2);  // the second layer may take a little longer than was foretold
    percent = status.percent;
    left = *status.left;
    CHECK(status.temperatures.nozzle.value() > 180);
    CHECK(to_json(status)["state"] == "printing");
  });
  CHECK(mixtures.count("sea") == 1);
  CHECK(mixtures.count("sun") == 1);
  CHECK(percent > 95);
  CHECK(states == std::vector<SessionState>{SessionState::heating, SessionState::printing,
                                            SessionState::finishing, SessionState::done});
  CHECK(bench.last().left == 0);
}

TEST_CASE("A print that is held before its first move also cools, and is hot before it goes on") {
  SessionBench bench;
  bench.settings.pause_heat = PauseHeat::lower;
  bench.settings.longest_pause = 60;
  const StreamResult result = bench.print([](Session& session, const SessionEvent& event) {
    if (event.kind == Kind::state && session.status().state == SessionState::heating) session.pause();
  });
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 1);
  const std::vector<std::string> lines = bench.executed();
  const auto cooled = std::find(lines.begin(), lines.end(), "M104 S150");
  const auto hot = std::find(cooled, lines.end(), "M109 S210");
  const auto laid = std::find_if(lines.begin(), lines.end(),
                                 [](const std::string& line) { return line.starts_with("G1 X"); });
  REQUIRE(hot != lines.end());
  CHECK(hot < laid);
}

TEST_CASE("Heaters are cold or the firmware has killed itself, however a print ends") {
  const std::string fault =
      GENERATE("", "reset@line=300", "thermistor@line=300", "fatal:Something broke@line=300",
               "silence@line=300", "runaway@t=60", "stall:20@line=300");
  CAPTURE(fault);
  SessionBench bench(fault.empty() ? Lines{} : Lines{"--fault", fault});
  const StreamResult result = bench.print();
  CHECK((result.ending == Ending::completed) == (fault.empty() || fault == "stall:20@line=300"));
  if (result.ending == Ending::failed) CHECK(result.reason.size() > 20);
  CHECK((bench.cold() || bench.seen()["killed"] == true || fault == "silence@line=300"));
}

TEST_CASE("A user's start lines cannot switch M85 off, and a warning says so") {
  SessionBench bench({}, "\n[gcode]\nstart = \"M85 S0\"\n");
  REQUIRE(bench.print().ending == Ending::completed);
  const Lines lines = bench.executed();
  const auto last =
      std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.rfind("G1 X", 0) == 0; });
  const auto watch = std::find_if(std::make_reverse_iterator(last), lines.rend(),
                                  [](const auto& l) { return l.rfind("M85", 0) == 0; });
  REQUIRE(watch != lines.rend());
  CHECK(*watch == "M85 S1800");
  const auto& told = bench.last().warnings;
  CHECK(std::any_of(told.begin(), told.end(),
                    [](const auto& w) { return w.find("M85") != std::string::npos; }));
}

TEST_CASE("A firmware that takes an extrusion for a mistake holds the print, too") {
  SessionBench bench({"--fault", "say:echo: too long extrusion prevented@line=200"});
  std::string why;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state || session.status().state != SessionState::paused) return;
    why = session.status().reason;
    CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  CHECK(why.find("EXTRUDE_MAXLENGTH") != std::string::npos);
}

TEST_CASE("What the printer repeats is shown once with a count") {
  std::vector<std::string> options;
  for (int line = 200; line < 223; ++line)
    options.insert(options.end(), {"--fault", "say:echo:again@line=" + std::to_string(line)});
  SessionBench bench(options);
  std::vector<std::string> shown;
  bench.print([&](Session&, const SessionEvent& event) {
    if (event.kind == Kind::printer && event.text.find("again") != std::string::npos)
      shown.push_back(event.text);
  });
  CHECK(shown ==
        std::vector<std::string>{"echo:again", "echo:again (10 times so far)", "echo:again (23 times)"});
}

TEST_CASE("A printer with fewer virtual tools than the print needs is refused before it heats") {
  SessionBench bench({"--personality", "marlin-few-tools"});
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::failed);
  CHECK(result.unfit);
  CHECK_FALSE(result.begun);
  CHECK(result.reason.find("fewer virtual tools than the ") != std::string::npos);
  for (const std::string& line : bench.executed()) CHECK_FALSE(line.starts_with("M109"));
}

TEST_CASE("Speed and flow together do not push more than the nozzle can melt") {
  SessionBench bench;  // 3 of 5 mm³/s
  bool tried = false;
  bench.print(at(40, [&](Session& session) {
    tried = true;
    CHECK(session.set_speed(170).value().find("max_flow is 5") != std::string::npos);
    CHECK_FALSE(session.set_speed(160));
    CHECK(session.set_flow(110).value().find("5.28 mm³/s") != std::string::npos);
    CHECK_FALSE(session.set_flow(104));
  }));
  CHECK(tried);
}

TEST_CASE("A change of flow waits until the filament is not drawn back") {
  SessionBench bench;
  bool asked = false;
  const StreamResult result = bench.print(
      [&, hold = at(40, [](Session& s) { s.pause(); })](Session& session, const SessionEvent& event) mutable {
        hold(session, event);
        if (event.kind != Kind::state || session.status().state != SessionState::paused || asked) return;
        asked = true;
        CHECK_FALSE(session.set_flow(90));
        CHECK_FALSE(session.set_bed(40));
        CHECK_FALSE(session.resume());
      });
  CHECK(result.ending == Ending::completed);
  const Lines lines = bench.executed();
  const std::size_t back = index_of(lines, "G1 E-4 F1500"), change = index_of(lines, "M221 S90");
  REQUIRE(change < lines.size());
  CHECK(back < change);
  double drawn = 0;  // at the change
  for (std::size_t i = 0; i < change; ++i) {
    if (lines[i].starts_with("G1 E")) drawn += std::stod(lines[i].substr(4));
  }
  CHECK(std::count_if(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(change),
                      [](const auto& l) { return l.starts_with("G1 E-"); }) > 0);
  CHECK(drawn >= 0);
}

TEST_CASE("Reports of temperatures end with the print") {
  SessionBench bench;
  bench.settings.link.temperatures = std::chrono::seconds(2);
  REQUIRE(bench.print().ending == Ending::completed);
  CHECK(bench.executed().back() == "M155 S0");
}

TEST_CASE("An unknown command in the start lines is mentioned") {
  SessionBench bench({}, "\n[gcode]\nstart = \"M9999 S1\"\n");
  REQUIRE(bench.print().ending == Ending::completed);
  const auto& told = bench.last().warnings;
  CHECK(std::any_of(told.begin(), told.end(),
                    [](const auto& w) { return w.find("M9999 S1") != std::string::npos; }));
}

TEST_CASE("A disturbed line to a firmware that takes damaged lines is mentioned") {
  const std::string firmware = GENERATE("marlin", "repetier");
  unicursal::test::SampleFiles sample;
  sample.profile = unicursal::test::replaced(sample.profile, "\"marlin\"", "\"" + firmware + "\"");
  SessionBench bench({"--personality", firmware, "--fault", "falsealarm@line=200"}, "", sample);
  REQUIRE(bench.print().ending == Ending::completed);
  const auto& told = bench.last().warnings;
  CHECK((firmware == "repetier") == std::any_of(told.begin(), told.end(), [](const auto& w) {
          return w.find("without a word") != std::string::npos;
        }));
}

TEST_CASE("A stop while a firmware without emergency parser heats ends within a minute") {
  SessionBench bench({}, "\n[gcode]\nstart = \"M140 S110\\nM190 S110\\nG4 S1\\nG4 S1\\nG4 S1\\nG4 S1\"\n");
  double asked = -1;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (asked < 0 && status.state == SessionState::heating && status.elapsed > 20 &&
        event.kind != Kind::state) {
      asked = status.elapsed;
      CHECK_FALSE(session.cancel());
    }
  });
  CHECK(asked > 0);
  CHECK(result.ending == Ending::stopped);
  CHECK(bench.last().elapsed - asked < 60);
}

TEST_CASE("A cable that is pulled during a stop is reported, since nobody knows whether the printer cools") {
  SessionBench bench({"--personality", "marlin-8bit", "--fault", "disconnect@t=20"});
  bool stopped = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent&) {
    const SessionStatus status = session.status();
    if (status.state != SessionState::heating || status.elapsed < 10 || std::exchange(stopped, true)) return;
    CHECK_FALSE(session.cancel());
  });
  CHECK(stopped);
  CHECK(result.ending == Ending::failed);
  CHECK(result.reason.find("connection to the printer was lost") != std::string::npos);
}
