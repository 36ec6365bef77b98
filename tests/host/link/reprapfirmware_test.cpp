// A firmware that neither compares line numbers nor asks for lines again: what the link makes of its silence,
// and whole prints on it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "host/link/whereabouts.hpp"
#include "tests/host/support/print_bench.hpp"
#include "tests/host/support/session_bench.hpp"
#include "virtual_printer.hpp"

using namespace unicursal;
using namespace unicursal::host;
using test::SessionBench;
using test::Talk;
using test::VirtualPrinter;

namespace {

using Verdict = Whereabouts::Verdict;

const std::string profile =
    test::replaced(test::sample_profile, "firmware = \"marlin\"", "firmware = \"reprapfirmware\"");

std::vector<std::string> moves(std::size_t count) {
  std::vector<std::string> lines{"T0 P0", "G28", "G90", "M83"};
  for (std::size_t i = 0; i < count; ++i)
    lines.push_back(fmt::format("G1 X{:.3f} Y{} F6000", 1 + 0.01 * static_cast<double>(i), 1 + i % 3));
  return lines;
}

Talk print_moves(VirtualPrinter& printer, const std::vector<std::string>& lines) {
  return printer.print(lines);
}

test::SampleFiles on_reprapfirmware() {
  test::SampleFiles sample;
  sample.profile = profile;
  return sample;
}

bool holds(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

/// The lines without those that pauses and questions insert.
std::vector<std::string> beads(std::vector<std::string> lines) {
  std::erase_if(
      lines, [](const std::string& line) { return !line.starts_with("G1 X") && !line.starts_with("G1 Y"); });
  return lines;
}

std::vector<std::string> undisturbed() {
  SessionBench bench({}, "", on_reprapfirmware());
  REQUIRE(bench.print().ending == Ending::completed);
  return beads(bench.executed());
}

}  // namespace

TEST_CASE("the place of the nozzle shows whether a move was executed") {
  Whereabouts nozzle;
  for (const char* line : {"G28", "G90", "G1 X10 Y5 Z.2 F600"}) nozzle.done(line);
  CHECK(nozzle.judge("G1 X11 E.5", {11, 5, 0.2}) == Verdict::done);
  CHECK(nozzle.judge("G1 X11 E.5", {10, 5, 0.2}) == Verdict::repeatable);
  CHECK(nozzle.judge("G1 X11 Y6 E.5", {11, 5, 0.2}) == Verdict::unknown);
  CHECK(nozzle.judge("G1 X10 E.5", {10, 5, 0.2}) == Verdict::unknown);  // it moves nothing but filament
  CHECK(nozzle.judge("G1 E-4 F1500", {10, 5, 0.2}) == Verdict::unknown);
  CHECK(nozzle.judge("G1 F1500", {10, 5, 0.2}) == Verdict::repeatable);
  CHECK(nozzle.judge("M567 P0 E.5:.5:0", {10, 5, 0.2}) == Verdict::repeatable);
  CHECK(nozzle.judge("T0 P0", {10, 5, 0.2}) == Verdict::repeatable);
  CHECK(nozzle.judge("M98 P\"own.g\"", {10, 5, 0.2}) == Verdict::unknown);
  nozzle.done("G91");
  CHECK(nozzle.judge("G1 X1", {11, 5, 0.2}) == Verdict::unknown);
  nozzle.done("G90");
  nozzle.done("G92 X100");
  CHECK(nozzle.judge("G1 X101", {101, 5, 0.2}) == Verdict::done);
  nozzle.done("G28 X");
  CHECK(nozzle.judge("G1 X5", {5, 5, 0.2}) == Verdict::repeatable);
  CHECK(nozzle.judge("G1 X5 E1", {5, 5, 0.2}) == Verdict::unknown);  // it may have been there before
}

TEST_CASE("lost lines and lost replies of a RepRapFirmware: each line is executed once, in order") {
  // A damaged line is dropped like one for which the alarm is false.
  const std::string fault = GENERATE("falsealarm:0.01", "merge:0.01", "lostok:0.01", "brokenok:0.01",
                                     "noise:0.01", "lostreply:2e-3");
  CAPTURE(fault);
  VirtualPrinter printer({"--personality", "reprapfirmware", "--fault", fault});
  const std::vector<std::string> lines = moves(600);
  const Talk talk = print_moves(printer, lines);
  CHECK(talk.error.empty());
  CHECK(printer.report()["lines"]["resends"] == 0);
  CHECK(beads(printer.executed()) == beads(lines));
  CHECK(talk.statistics.probes > 0);
}

TEST_CASE("a lost ok of a RepRapFirmware costs less than 5 s, as it shows life every 2 s while it works") {
  VirtualPrinter printer({"--personality", "reprapfirmware", "--fault", "lostok@line=100"});
  const Talk lost = print_moves(printer, moves(300));
  VirtualPrinter other({"--personality", "reprapfirmware"});
  const Talk sound = print_moves(other, moves(300));
  CHECK(lost.error.empty());
  CHECK(sound.statistics.probes == 0);
  CHECK(lost.seconds - sound.seconds < 5);
}

TEST_CASE("a lost retraction cannot be seen: the link ends with a sentence that names the line") {
  std::vector<std::string> lines = moves(50);
  lines.push_back("G1 E-4 F1500");
  const std::string at = fmt::format("lostok@line={}", lines.size());
  VirtualPrinter printer({"--personality", "reprapfirmware", "--fault", at});
  const Talk talk = print_moves(printer, lines);
  CHECK(talk.error.find("\"G1 E-4 F1500\"") != std::string::npos);
  CHECK(talk.error.find("unicursal resume") != std::string::npos);
}

TEST_CASE("a slow command of a RepRapFirmware is waited for") {
  std::vector<std::string> lines = moves(5);
  lines.push_back("G4 S200");
  lines.push_back("G1 X20");
  VirtualPrinter printer({"--personality", "reprapfirmware"});
  const Talk talk = print_moves(printer, lines);
  CHECK(talk.error.empty());
  CHECK(talk.seconds > 200);
  CHECK(beads(printer.executed()) == beads(lines));
}

TEST_CASE("a RepRapFirmware is printed on, paused, and goes on where it was") {
  const auto plain = undisturbed();
  SessionBench bench({}, "", on_reprapfirmware());
  bool once = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionState state = session.status().state;
    if (event.kind == SessionEvent::Kind::progress && session.status().layer > 0 &&
        !std::exchange(once, true))
      session.pause();
    if (event.kind == SessionEvent::Kind::state && state == SessionState::paused) session.resume();
  });
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 1);
  CHECK(beads(bench.executed()).size() >= plain.size());
  CHECK(bench.seen()["executed_lines_in_order"] == true);
  CHECK(bench.seen()["warnings"].empty());
}

TEST_CASE("a cancelled print leaves a RepRapFirmware cold, with the nozzle aside") {
  SessionBench bench({}, "", on_reprapfirmware());
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind == SessionEvent::Kind::progress && session.status().layer > 0) session.cancel();
  });
  CHECK(result.ending == Ending::stopped);
  CHECK(result.parked);
  CHECK(bench.cold());
}

TEST_CASE("an emergency stop halts a RepRapFirmware") {
  SessionBench bench({}, "", on_reprapfirmware());
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind == SessionEvent::Kind::progress && session.status().layer > 0) session.emergency_stop();
  });
  CHECK(result.ending != Ending::completed);
  CHECK(bench.cold());
  CHECK(holds(bench.executed(), "M112"));
}

TEST_CASE("what stops a RepRapFirmware, or only its plastic, never ends as done") {
  const std::string fault =
      GENERATE("stopped@line=150", "fatal:short circuit@line=150", "reset@line=150",
               "say:Error: G1: insufficient axes homed@line=150",
               "say:Error: Attempting to extrude with no tool selected.@line=150", "silence@line=150");
  CAPTURE(fault);
  SessionBench bench({"--fault", fault}, "", on_reprapfirmware());
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::failed);
  CHECK_FALSE(result.reason.empty());
}

TEST_CASE("a heater of a RepRapFirmware that fails pauses the print aside") {
  const std::string fault = GENERATE("heaterfail@line=150",
                                     "say:Warning: Tool 0 was not driven because its heater "
                                     "temperatures were not high enough or it has a heater "
                                     "fault@line=150");
  CAPTURE(fault);
  SessionBench bench({"--fault", fault}, "", on_reprapfirmware());
  bool paused = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != SessionEvent::Kind::state || session.status().state != SessionState::paused) return;
    paused = true;
    session.cancel();
  });
  CHECK(result.ending != Ending::completed);
  // The sample print may be done before a dying heater is noticed; the words always pause it.
  CHECK((paused || fault.starts_with("heaterfail")));
}

TEST_CASE("a print on a RepRapFirmware whose host is killed is resumed without losing or repeating a line") {
  test::PrintBench undisturbed_bench(100, {}, profile);
  REQUIRE(test::run(undisturbed_bench.print()).code == 0);
  const test::Seen whole = undisturbed_bench.seen();
  test::PrintBench bench(100, {}, profile);
  test::Child host(bench.print());
  test::PrintBench::wait_for(
      [&] {
        const std::string orders = test::read_text(bench.path("t.txt"));
        return std::count(orders.begin(), orders.end(), '\n') > 150;
      },
      host);
  kill(host.id(), SIGKILL);
  host.wait();
  const test::Outcome outcome = bench.resume_anyway();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  const test::Seen seen = bench.seen();
  const auto executed = beads(seen.lines), expected = beads(whole.lines);
  CHECK(executed.size() >= expected.size());
  CHECK(executed.size() <= expected.size() + 30);
}

TEST_CASE("doctor examines a RepRapFirmware, and compares its limits with the profile") {
  test::PrintBench bench(0, {}, profile);
  const test::Outcome outcome =
      test::run({"doctor", "--port", bench.path("port"), "--profile", bench.path("bench.toml")});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  const auto says = [&](const std::string& part) { return outcome.out.find(part) != std::string::npos; };
  CHECK(outcome.out.starts_with("RepRapFirmware for Duet 2"));
  CHECK(says("this program speaks RepRapFirmware"));
  CHECK(says("its tool 0 mixes the filament of its 3 feeders"));
  CHECK(says("M85 has no effect on it"));
  CHECK(says("its max_speed is not below that of the profile"));
  CHECK(says("its max_acceleration is not below that of the profile"));
  for (const std::string& line : bench.seen().lines)
    CHECK((line == "M92" || line == "M203" || line == "M201" || line == "M200" || line == "M114"));
}

TEST_CASE("the transition strip is printed on a RepRapFirmware") {
  test::PrintBench bench(0, {}, profile);
  const test::Outcome outcome =
      test::run({"tune", "transition", bench.path("bench.toml"), "--port", bench.path("port")});
  INFO(outcome.out << outcome.err);
  const test::Seen seen = bench.seen();
  CHECK(holds(seen.lines, "M567 P0 E"));
  CHECK(seen.report["warnings"].empty());
}
