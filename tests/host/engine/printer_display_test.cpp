// What the printer's own display shows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>

#include "host/engine/printer_display.hpp"
#include "tests/host/support/print_bench.hpp"
#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::gcode::Family;
using unicursal::gcode::Identity;
using unicursal::test::SessionBench;
using Lines = std::vector<std::string>;
using namespace std::chrono_literals;

namespace {

Identity printer(Family family, const std::vector<std::string>& can = {}) {
  Identity identity;
  identity.family = family;
  identity.learn("EEPROM", false);
  for (const std::string& one : can) identity.learn(one, true);
  return identity;
}

/// Noon, wherever the tests run.
PrinterDisplay::WallTime noon() {
  setenv("TZ", "UTC", 1);
  tzset();
  return PrinterDisplay::WallTime(std::chrono::hours(24 * 20000 + 12));
}

PrinterDisplay::Moment at(std::chrono::seconds time) {
  return {TimePoint(time), noon() + time};
}

bool is_display(const std::string& line) {
  return line.starts_with("M117") || line.starts_with("M73");
}

Lines display_lines(Lines lines) {
  std::erase_if(lines, [](const std::string& line) { return !is_display(line); });
  return lines;
}

/// Without the link's question, which it asks after an unknown command.
Lines other_lines(Lines lines) {
  std::erase_if(lines, [](const std::string& line) { return is_display(line) || line == "M105"; });
  return lines;
}

}  // namespace

TEST_CASE("A display shows the layer and the time of day at which the part is ready") {
  PrinterDisplay display;
  CHECK(display.due({3, 1, 260, 60}, at(0s)).empty());  // before the printer is known
  display.begin(printer(Family::marlin, {"BUILD_PERCENT"}), "marlin");
  CHECK(display.due({3, 0, 260, 60}, at(0s)).empty());  // nothing is laid yet
  CHECK(display.due({3.9, 12, 260, 6121}, at(0s)) == Lines{"M73 P3 R103", "M117 Layer 12/260 13:42"});
  CHECK(display.done(at(6121s)) == Lines{"M73 P100 R0", "M117 Done 13:42"});
}

TEST_CASE("A display's text fits on 20 characters") {
  const auto [layer, layers, left, text] = GENERATE(table<std::size_t, std::size_t, double, std::string>({
      {1200, 2600, 60, "M117 1200/2600 12:01"},
      {12, 260, 20 * 3600, "M117 12/260 Sat 08:00"},
      {1, 4, 20 * 3600, "M117 Layer 1/4 Sat 08:00"},
      {12345, 23456, 20 * 3600, "M117 12345/23456"},
  }));
  PrinterDisplay display;
  display.begin(printer(Family::marlin), "marlin");
  CHECK(display.due({1, layer, layers, left}, at(0s)) == Lines{text});
  CHECK(text.size() <= std::string("M117 ").size() + 20);
}

TEST_CASE("A display is renewed at a new layer or per cent and once a minute, with 10 s between") {
  PrinterDisplay display;
  display.begin(printer(Family::marlin, {"BUILD_PERCENT"}), "marlin");
  CHECK(display.due({1, 1, 9, 600}, at(0s)).size() == 2);
  CHECK(display.due({2, 2, 9, 600}, at(9s)).empty());
  CHECK(display.due({2, 1, 9, 600}, at(10s)) == Lines{"M73 P2 R10"});
  CHECK(display.due({2, 2, 9, 580}, at(20s)) == Lines{"M117 Layer 2/9 12:10"});
  CHECK(display.due({2, 2, 9, 500}, at(79s)).empty());
  CHECK(display.due({2, 2, 9, 500}, at(80s)) == Lines{"M73 P2 R9", "M117 Layer 2/9 12:09"});
  CHECK(display.word("Paused") == Lines{"M117 Paused"});
  CHECK(display.word("Paused").empty());
  CHECK(display.due({2, 2, 9, 500}, at(81s)) == Lines{"M117 Layer 2/9 12:09"});  // the pause is over
}

TEST_CASE("Only a Marlin that lists M73, or nothing at all, is sent it") {
  PrinterDisplay::Progress progress{1, 1, 9, 600};
  Identity bare;
  bare.family = Family::marlin;
  for (const auto& [who, firmware, lines] : std::vector<std::tuple<Identity, std::string, std::size_t>>{
           {printer(Family::marlin, {"BUILD_PERCENT"}), "marlin", 2},
           {printer(Family::marlin), "marlin", 1},
           {bare, "marlin", 2},
           {Identity{}, "marlin", 2},
           {Identity{}, "repetier", 1},
           {printer(Family::repetier), "repetier", 1},
           {printer(Family::reprapfirmware), "reprapfirmware", 1}}) {
    PrinterDisplay display;
    display.begin(who, firmware);
    CHECK(display.due(progress, at(0s)).size() == lines);
  }
}

TEST_CASE("What a printer does not know is not sent again, and its answer is not news") {
  PrinterDisplay display;
  CHECK_FALSE(display.hear("echo:Unknown command: \"M73 P1 R2\""));  // it was not asked
  display.begin(Identity{}, "marlin");
  CHECK(display.due({1, 1, 9, 600}, at(0s)).size() == 2);
  CHECK_FALSE(display.hear("echo:Unknown command: \"M900 K0\""));
  CHECK_FALSE(display.hear("//action:notification E1 Heating..."));
  CHECK(display.hear("//action:notification Layer 1/9 12:10"));
  CHECK(display.hear("echo:Unknown command: \"M73 P1 R10\""));
  CHECK_FALSE(display.hear("echo:Unknown command: \"M73 P1 R10\""));
  CHECK(display.due({2, 2, 9, 600}, at(60s)) == Lines{"M117 Layer 2/9 12:11"});
  CHECK(display.hear("Unknown command:N9 M117 Layer 2/9 "));
  CHECK(display.due({3, 3, 9, 600}, at(120s)).empty());
  CHECK(display.done(at(600s)).empty());
}

TEST_CASE("Every firmware's display shows a print, whose own lines stay the same") {
  const auto [who, firmware, numbers] = GENERATE(table<std::string, std::string, std::size_t>({
      {"marlin", "marlin", 0},
      {"marlin-host", "marlin", 2},
      {"marlin-plain", "marlin", 1},
      {"repetier", "repetier", 0},
      {"reprapfirmware", "reprapfirmware", 0},
  }));
  CAPTURE(who);
  unicursal::test::SampleFiles files;
  files.profile = unicursal::test::replaced(files.profile, "\"marlin\"", "\"" + firmware + "\"");
  Lines without;
  {
    SessionBench bench({"--personality", who}, {}, files);
    CHECK(bench.print().ending == Ending::completed);
    without = other_lines(bench.executed());
    CHECK(display_lines(bench.executed()).empty());
  }
  SessionBench bench({"--personality", who}, {}, files);
  bench.settings.display = true;
  Lines news;
  const StreamResult result = bench.print([&](Session&, const SessionEvent& event) {
    if (event.text.find("M73") != std::string::npos || event.text.find("Layer") != std::string::npos)
      news.push_back(event.text);
  });
  CHECK(result.ending == Ending::completed);
  CHECK(result.statistics.resends == 0);
  CHECK(news.empty());
  CHECK(other_lines(bench.executed()) == without);
  const Lines shown = display_lines(bench.executed());
  CHECK(shown.size() < 40);
  const std::regex layer("M117 Layer [12]/2 [0-2][0-9]:[0-5][0-9]"), done("M117 Done [0-2][0-9]:[0-5][0-9]");
  std::size_t layers = 0, m73 = 0;
  for (const std::string& line : shown) {
    layers += std::regex_match(line, layer) ? 1 : 0;
    m73 += line.starts_with("M73") ? 1 : 0;
  }
  CHECK(layers >= 2);
  CHECK(std::regex_match(shown.back(), done));
  CHECK((numbers == 2 ? m73 > 2 : m73 == numbers));
  const auto screen = bench.seen()["display"];
  CHECK("M117 " + screen["text"].get<std::string>() == shown.back());
  if (numbers == 2) {
    CHECK(screen["percent"] == 100);
    CHECK(screen["minutes_left"] == 0);
  }
}

TEST_CASE("A display shows that a print is paused and that it was cancelled") {
  SessionBench bench({"--personality", "marlin-host"});
  bench.settings.display = true;
  int paused = 0;
  bool began = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (status.state == SessionState::printing && status.layer == 1 && status.percent > 20 && !began) {
      began = true;
      session.pause();
    }
    if (event.kind != SessionEvent::Kind::state) return;
    if (status.state == SessionState::paused && ++paused == 1) session.resume();
    if (status.state == SessionState::printing && paused == 1) session.cancel("a test wants it");
  });
  CHECK(result.ending == Ending::stopped);
  const Lines shown = display_lines(bench.executed());
  CHECK(std::count(shown.begin(), shown.end(), "M117 Paused") == 1);
  CHECK(shown.back() == "M117 Cancelled");
  CHECK(bench.seen()["display"]["text"] == "Cancelled");
}

TEST_CASE("While a printer waits for a person its display is left alone") {
  SessionBench bench({"--personality", "marlin-host", "--fault", "filamentchange@line=200"});
  bench.settings.display = true;
  bench.settings.link.temperatures = 2s;
  bench.settings.longest_pause = 600;
  std::size_t texts = 0;
  CHECK(bench.print().ending == Ending::completed);
  const Lines shown = bench.executed();
  const auto change = std::find(shown.begin(), shown.end(), "M600 T0");
  REQUIRE(change != shown.end());
  texts = static_cast<std::size_t>(std::count_if(change, std::next(change, 2), is_display));
  CHECK(texts == 0);
  CHECK(display_lines(shown).back().starts_with("M117 Done"));
}

TEST_CASE("A print that is killed and resumed goes on line by line, whatever its display shows",
          "[optimised]") {
  const std::string who = GENERATE("marlin-host", "repetier", "reprapfirmware");
  CAPTURE(who);
  const std::string firmware = who == "marlin-host" ? "marlin" : who;
  const std::string profile =
      unicursal::test::replaced(unicursal::test::sample_profile, "\"marlin\"", "\"" + firmware + "\"");
  const std::vector<std::string> options{"--personality", who, "--usb", "none"};
  unicursal::test::PrintBench whole(0, options, profile);
  CHECK(unicursal::test::run(whole.print()).code == 0);
  const unicursal::test::Seen expected = whole.seen();
  unicursal::test::PrintBench bench(100, options, profile);
  {
    unicursal::test::Child host(bench.print());
    const auto laying = [&] {
      const std::string lines = unicursal::test::read_text(bench.path("t.txt"));
      return lines.find("M117 Layer") != std::string::npos && lines.ends_with("\n") &&
             std::count(lines.begin(), lines.end(), '\n') > 300;
    };
    unicursal::test::PrintBench::wait_for(laying, host);
    REQUIRE(host.running());
    kill(host.id(), SIGKILL);
    host.wait();
  }
  const unicursal::test::Outcome outcome = bench.resume_anyway();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  const unicursal::test::Seen seen = bench.seen();
  check_equal(seen, expected);
  CHECK(seen.report["display"]["texts"] >= 3);
  CHECK(seen.report["display"]["text"].get<std::string>().starts_with("Done "));
}

TEST_CASE("A profile can keep the display as it is") {
  unicursal::test::PrintBench bench(
      0, {}, unicursal::test::replaced(unicursal::test::sample_profile, "baud =", "display = false\nbaud ="));
  CHECK(unicursal::test::run(bench.print()).code == 0);
  CHECK(bench.seen().report["display"]["texts"] == 0);
}
