// A printer that waits for a person: a change of filament, a stop in the start lines, its questions.
#include <algorithm>
#include <catch2/catch.hpp>

#include "host/link/host_prompt.hpp"
#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::test::SessionBench;
using Kind = SessionEvent::Kind;

namespace {

const std::vector<std::string> runs_out{"--personality", "marlin-host", "--fault", "filamentchange@line=200"};

}  // namespace

TEST_CASE("What a printer writes on its buttons is made safe to show") {
  HostPrompt prompt;
  prompt.take("prompt_begin \x1b[31mRed");
  prompt.take("prompt_button \x07Go");
  prompt.take("prompt_show");
  CHECK(prompt.sentence() == "the printer asks \"\\x1b[31mRed\": answer 0 (\\x07Go)");
}

TEST_CASE("A question of the firmware is put together from its lines") {
  HostPrompt prompt;
  CHECK_FALSE(prompt.take("prompt_end"));
  CHECK_FALSE(prompt.take("prompt_begin Paused"));
  CHECK_FALSE(prompt.take("prompt_button PurgeMore"));
  CHECK_FALSE(prompt.take("prompt_choice Continue"));
  CHECK_FALSE(prompt.shown());
  CHECK(prompt.take("prompt_show"));
  CHECK(prompt.shown());
  CHECK(prompt.going_on() == 1);
  CHECK(prompt.sentence() == "the printer asks \"Paused\": answer 0 (PurgeMore) or 1 (Continue)");
  CHECK(prompt.take("prompt_end"));
  CHECK_FALSE(prompt.shown());
  prompt.take("prompt_begin Resuming");
  prompt.take("prompt_button Dismiss");
  CHECK_FALSE(prompt.take("prompt_show"));
  prompt.take("prompt_begin Only text");
  CHECK_FALSE(prompt.take("prompt_show"));  // nothing to answer
  for (int i = 0; i < 100; ++i) prompt.take("prompt_button B");
  CHECK(prompt.buttons().size() == HostPrompt::most_buttons);
  CHECK_FALSE(HostPrompt().take("prompt_buttons are not a word"));
}

TEST_CASE("While the printer waits for a person the print is paused, and resume lets it go on") {
  SessionBench bench(runs_out);
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  std::vector<std::string> asked;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind != Kind::state || status.state != SessionState::paused) return;
    if (status.reason.find("the printer asks") == std::string::npos) return;
    asked.push_back(status.reason);
    CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  CHECK(asked ==
        std::vector<std::string>{"the printer asks \"Nozzle Parked\": answer 0 (Continue)",
                                 "the printer asks \"Paused\": answer 0 (PurgeMore) or 1 (DisableRunout)"});
  CHECK(result.pauses == 1);
  // The answer that lets it go on switches its sensor off; the print switches it on again.
  const auto lines = bench.executed();
  const auto line = std::find(lines.begin(), lines.end(), "M412 S1");
  CHECK(line != lines.end());
  CHECK(std::find_if(line, lines.end(), [](const auto& l) { return l.starts_with("G1"); }) != lines.end());
  CHECK(bench.seen()["executed_lines_in_order"] == true);
}

TEST_CASE("A printer whose filament has run out twice is noticed twice") {
  SessionBench bench({"--personality", "marlin-host", "--fault", "filamentchange@line=200", "--fault",
                      "filamentchange@line=600"});
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind != Kind::state || status.state != SessionState::paused || !status.prompt) return;
    if (status.reason.find("the printer asks") != std::string::npos) CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 2);
  CHECK(bench.seen()["executed_lines_in_order"] == true);
}

TEST_CASE("A question is answered by the number of a button, and the answer is the one that was chosen") {
  SessionBench bench(runs_out);
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  std::vector<std::string> asked;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state) return;
    const auto prompt = session.status().prompt;
    if (!prompt) {
      if (session.status().state == SessionState::printing)
        CHECK(session.answer(0) == "the printer does not ask anything");
      return;
    }
    asked.push_back(prompt->text);
    const auto refusal = session.answer(prompt->answers.size());
    REQUIRE(refusal);
    CHECK(refusal->find("is not one of its answers") != std::string::npos);
    // More is purged once.
    const bool purges = prompt->text == "Paused" && std::count(asked.begin(), asked.end(), "Paused") == 1;
    CHECK_FALSE(session.answer(purges ? 0 : prompt->answers.size() - 1));
    CHECK(session.answer(0) == "the printer does not ask anything");
  });
  CHECK(result.ending == Ending::completed);
  CHECK(asked == std::vector<std::string>{"Nozzle Parked", "Paused", "Paused"});
  // The person has chosen to print without the sensor.
  const auto lines = bench.executed();
  CHECK(std::find(lines.begin(), lines.end(), "M412 S1") == lines.end());
}

TEST_CASE("A stop while the printer waits for a person parks and cools it") {
  SessionBench bench(runs_out);
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  const StreamResult result = bench.print([](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind == Kind::state && status.state == SessionState::paused &&
        status.reason.find("Nozzle Parked") != std::string::npos)
      session.cancel();
  });
  CHECK(result.ending == Ending::stopped);
  CHECK(result.parked);
  CHECK(bench.cold());
}

TEST_CASE("A print goes on when a person has pressed the printer's own button, also if its word is lost") {
  SessionBench bench(
      {"--fault", "say://action:paused@line=200", "--fault", "say:echo:busy: paused for user@line=200"});
  const StreamResult result = bench.print();
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 1);
  CHECK(bench.seen()["printer_seconds"].get<double>() < 400);
}

TEST_CASE("A nozzle whose firmware announces a pause and makes none is taken aside, until a person resumes") {
  SessionBench bench({"--fault", "runout@line=200"});
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  double since = -1, aside = -1;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    const SessionStatus status = session.status();
    if (event.kind == Kind::state && status.state == SessionState::paused && since < 0)
      since = status.elapsed;
    if (event.kind != Kind::state || status.state != SessionState::paused) return;
    if (status.reason.find("taken aside") == std::string::npos) return;
    aside = status.elapsed;
    CHECK(status.reason.find("filament_runout") != std::string::npos);
    CHECK_FALSE(session.resume());
  });
  CHECK(result.ending == Ending::completed);
  CHECK(result.pauses == 1);
  CHECK(aside - since < 15);
  CHECK(aside > 0);
  const auto lines = bench.executed();
  CHECK(std::any_of(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("G0 X5 Y5"); }));
}

TEST_CASE("A stop in the start lines holds the print with a reason, and resume ends it") {
  SessionBench bench({"--personality", "marlin-host"}, "\n[gcode]\nstart = \"M0\"\n");
  bench.settings.link.temperatures = std::chrono::seconds(2);
  bench.settings.longest_pause = 3600;
  bool waited = false;
  const StreamResult result = bench.print([&](Session& session, const SessionEvent& event) {
    if (event.kind != Kind::state || session.status().state != SessionState::paused) return;
    waited = true;
    CHECK(session.status().reason.find("M0 Stop") != std::string::npos);
    CHECK_FALSE(session.resume());
  });
  CHECK(waited);
  CHECK(result.ending == Ending::completed);
}
