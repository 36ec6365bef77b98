// Prints on a printer that they were not made for, with every command that prints, as real processes.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "host/engine/printer_check.hpp"
#include "tests/host/link/fake_printer.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using namespace unicursal::host;
using test::Child;
using test::FakePrinter;
using test::Outcome;
namespace fs = std::filesystem;

namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string profile_for(const std::string& firmware) {
  return test::replaced(test::sample_profile, "\"marlin\"", "\"" + firmware + "\"");
}

/// A folder with a job, and a printer of some firmware.
class Bench {
 public:
  explicit Bench(const std::string& profile = test::sample_profile) {
    folder_.write("bench.toml", profile);
    folder_.write("plate.svg", test::sample_drawing);
    folder_.write("job.toml", test::sample_job);
  }

  std::string path(const std::string& name) const { return folder_ / name; }
  void start_printer(const std::string& personality, const std::string& link = "port",
                     const std::string& profile = test::sample_profile) {
    const auto file = folder_.write(link + "-profile.toml", profile);
    printers_[link] = std::make_unique<Child>(std::vector<std::string>{
        "simulate", "--profile", file.string(), "--personality", personality, "--link", path(link),
        "--transcript", path(link + ".txt"), "--speed", "100"});
    test::await([&] { return fs::exists(path(link)); }, *printers_[link]);
  }
  std::vector<std::string> print_on(const std::string& port) const {
    return {"print", path("job.toml"), "--port", port, "--spool", path("spool")};
  }
  /// The commands that the printer got besides questions; ends the printer.
  std::vector<std::string> orders(const std::string& link = "port") {
    kill(printers_[link]->id(), SIGTERM);
    printers_[link]->wait();
    std::istringstream transcript(test::read_text(path(link + ".txt")));
    std::vector<std::string> orders;
    for (std::string line; std::getline(transcript, line);) {
      const std::string word = line.substr(0, line.find(' '));
      const bool harmless =
          word == "M110" || word == "M155" || word == "M105" || word == "M114" || word == "M115";
      if (!harmless) orders.push_back(line);
    }
    return orders;
  }
  bool keeps_a_print() const { return fs::exists(path("spool")) && !fs::is_empty(path("spool")); }

 private:
  test::TempFolder folder_;
  std::map<std::string, std::unique_ptr<Child>> printers_;
};

/// A printer that answers lines that begin with `command` by `answer`, then ok.
test::FakeBehaviour answering(const std::string& command, const std::string& answer) {
  test::FakeBehaviour behaviour;
  behaviour.instead = [=](FakePrinter& printer, std::size_t, const std::string& line) {
    if (line.rfind(command, 0) != 0) return false;
    printer.reply(answer);
    printer.reply("ok");
    return true;
  };
  return behaviour;
}

/// A printer whose firmware has this name.
test::FakeBehaviour called(const std::string& firmware) {
  test::FakeBehaviour behaviour;
  behaviour.outwards = [=](const std::string& line) {
    return line.rfind("FIRMWARE_NAME", 0) == 0 ? "FIRMWARE_NAME:" + firmware + "\n" : line;
  };
  return behaviour;
}

}  // namespace

TEST_CASE("a print for the other firmware is refused before anything moves, with the remedy") {
  const auto [mine, other] = GENERATE(table<std::string, std::string>({{"marlin", "repetier"},
                                                                       {"repetier", "marlin"},
                                                                       {"marlin", "reprapfirmware"},
                                                                       {"reprapfirmware", "repetier"}}));
  Bench bench(profile_for(mine));
  bench.start_printer(other);
  const Outcome outcome = test::run(bench.print_on(bench.path("port")));
  CHECK(outcome.code == 2);
  INFO(outcome.err);
  CHECK(says(outcome.err, "set firmware = \"" + other + "\" in " + bench.path("bench.toml")));
  CHECK_FALSE(says(outcome.err, "unicursal resume"));
  CHECK_FALSE(bench.keeps_a_print());
  CHECK(bench.orders().empty());
}

TEST_CASE("a tuning strip and a daemon's job are refused like a print") {
  Bench bench;
  bench.start_printer("repetier");
  const Outcome tuned =
      test::run({"tune", "transition", bench.path("bench.toml"), "--port", bench.path("port")});
  CHECK(tuned.code == 2);
  CHECK(says(tuned.err, "set firmware = \"repetier\""));
  CHECK(bench.orders().empty());

  test::DaemonBench daemon;
  daemon.start_printer("100", {"--personality", "repetier"});
  daemon.serve();
  REQUIRE(daemon.command({"queue", "--add", "plate.toml"}).code == 0);
  daemon.command({"start"});
  daemon.await_job(1, "failed");
  const std::string reason = daemon.ask("GET", "/api/jobs/1")["reason"];
  CHECK(says(reason, "set firmware = \"repetier\""));
  CHECK_FALSE(says(reason, "resume"));
  CHECK_FALSE(says(daemon.transcript(), "M104"));
}

TEST_CASE("an interrupted print is not resumed on a printer with the other firmware, and is kept") {
  Bench bench;
  bench.start_printer("marlin");
  bench.start_printer("repetier", "other");
  Child host(bench.print_on(bench.path("port")));
  // Moves enough that some of them are certain to have been made.
  test::await(
      [&] {
        const std::string orders = test::read_text(bench.path("port.txt"));
        const auto first = orders.find("G1 ");
        return first != std::string::npos &&
               std::count(orders.begin() + static_cast<std::ptrdiff_t>(first), orders.end(), '\n') > 60;
      },
      host);
  kill(host.id(), SIGKILL);
  host.wait();
  const std::vector<std::string> resume{"resume", "--yes", "--spool", bench.path("spool"), "--port"};
  const auto resume_on = [&](const std::string& link) {
    std::vector<std::string> words = resume;
    words.push_back(bench.path(link));
    return test::run(words);
  };
  const Outcome outcome = resume_on("other");
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "its firmware is Repetier"));
  CHECK_FALSE(says(outcome.err, "set firmware"));  // the kept print stays in its dialect
  CHECK(bench.orders("other") == std::vector<std::string>{});
  CHECK(resume_on("port").code == 0);
}

TEST_CASE("a printer whose feeders do not mix is refused, also when it says so behind its ok") {
  const bool late = GENERATE(false, true);
  const std::string no = "echo:Unknown command: \"M163 S99 P1\"";
  std::atomic<bool> asked = false;  // and has not answered yet
  FakePrinter* self = nullptr;
  test::FakeBehaviour behaviour = answering("M163", no);
  if (late) {
    behaviour = answering("M163", "echo:busy: processing");
    behaviour.inwards = [&](const std::string& line) {
      if (says(line, "M105") && asked.exchange(false)) self->reply(no);
      if (says(line, "M163")) asked = true;
      return line;
    };
  }
  FakePrinter printer(behaviour);
  self = &printer;
  const Bench bench;
  const Outcome outcome = test::run(bench.print_on(printer.path()));
  printer.stop();
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "MIXING_EXTRUDER"));
  for (const std::string& line : printer.executed()) CHECK(line == "M163 S99 P1");
}

TEST_CASE("a RepRapFirmware with other drives in its tool than the profile says is refused before it heats") {
  const std::string mine = profile_for("reprapfirmware");
  Bench bench(mine);
  bench.start_printer("reprapfirmware", "port", test::replaced(mine, "feeders = 3", "feeders = 2"));
  const Outcome outcome = test::run(bench.print_on(bench.path("port")));
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "2 feeders meet in its tool 0"));
  for (const std::string& order : bench.orders()) CHECK((order == "M567 P0" || order == "M114"));
}

TEST_CASE("a RepRapFirmware without a tool 0 is refused") {
  CHECK(denies_mixing("Error: M567: Invalid tool number"));
  CHECK_FALSE(denies_mixing("Tool 0 mix ratios: 1.000:0.000"));
  CHECK(mixing_feeders("Tool 0 mix ratios: 1.000:0.000") == 2);
  CHECK_FALSE(mixing_feeders("Tool 0 is selected"));
  CHECK(says(does_not_mix("reprapfirmware"), "M563 P0 D0:1:2"));
}

TEST_CASE("an unknown printer is used, with a warning") {
  FakePrinter printer(called("Klipper v0.12.0"));
  const Bench bench;
  const Outcome outcome = test::run(bench.print_on(printer.path()));
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(says(outcome.err, "never met this printer's firmware (Klipper v0.12.0)"));
}

TEST_CASE("doctor compares a profile's firmware with the printer's") {
  FakePrinter printer(called("Repetier_1.0.4 PROTOCOL_VERSION:1.0"));
  const Bench bench;
  const Outcome outcome =
      test::run({"doctor", "--port", printer.path(), "--profile", bench.path("bench.toml")});
  CHECK(outcome.code == 2);
  CHECK(says(outcome.out, "set firmware = \"repetier\""));
}

TEST_CASE("a firmware that is named after another belongs to its family, unless it says otherwise") {
  const auto spoken = [](const char* line) { return dialect_of(gcode::identify(line).family); };
  CHECK(spoken("FIRMWARE_NAME:Prusa-Firmware 3.13.3 based on Marlin") == "marlin");
  CHECK(spoken("FIRMWARE_NAME:Repetier_0.92.9 FIRMWARE_URL:https://github.com/repetier/") == "repetier");
  CHECK(spoken("FIRMWARE_NAME: RepRapFirmware for Duet 2 FIRMWARE_VERSION: 3.4") == "reprapfirmware");
  CHECK_FALSE(mismatch(gcode::identify("FIRMWARE_NAME:Klipper"), "marlin"));
  CHECK_FALSE(mismatch(gcode::Identity{}, "repetier"));
}
