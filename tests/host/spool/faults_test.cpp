// Faults of a printer at random lines of a print: the print stops safely, reports what has happened, and is
// resumed. Real processes on a pseudo-terminal.
#include <catch2/catch.hpp>
#include <random>

#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"
#include "tests/host/support/print_bench.hpp"

using namespace unicursal;
using test::Child;
using test::Outcome;
using test::Seen;
using Lines = std::vector<std::string>;
namespace fs = std::filesystem;

namespace {

struct Mishap {
  std::string kind;                ///< The simulator's name of the fault.
  int speed;                       ///< Printer seconds per second; 0 = as fast as lines arrive.
  std::vector<std::string> words;  ///< The program must say one of these.
  Lines more = {};                 ///< Further options of the simulator.
  std::size_t at_once = 10;        ///< Trials in parallel, since they mostly wait.
};

/// A print with a fault.
struct Trial {
  Trial(const Mishap& mishap, std::size_t at)
      : line(at), bench(mishap.speed, options(mishap, at)), host(std::make_unique<Child>(bench.print())) {}

  static Lines options(const Mishap& mishap, std::size_t at) {
    Lines all{"--fault", mishap.kind + "@line=" + std::to_string(at)};
    all.insert(all.end(), mishap.more.begin(), mishap.more.end());
    return all;
  }

  std::size_t line;
  test::PrintBench bench;
  std::unique_ptr<Child> host;
  Outcome cut;
};

const Seen& undisturbed() {
  static const Seen seen = [] {
    test::PrintBench bench(0);
    REQUIRE(test::run(bench.print()).code == 0);
    return bench.seen();
  }();
  return seen;
}

bool is_bead(const std::string& line) {
  return line.rfind("G1 X", 0) == 0;
}

/// The same up to their last byte.
void check_records(const fs::path& file) {
  host::RecordReader reader(file);
  while (reader.next()) {
  }
  CHECK(reader.sound() == fs::file_size(file));
}

void check_kept(const fs::path& folder) {
  check_records(folder / "journal");
  check_records(folder / "chunks");
  const host::JournalState state = host::read_journal(folder / "journal");
  CHECK(state.acknowledged <= state.handed);
  REQUIRE(state.ended);
  CHECK(state.ended->outcome == host::LegOutcome::failed);
  CHECK_FALSE(state.ended->reason.empty());
}

void check_told(const Mishap& mishap, const Outcome& cut) {
  CHECK(cut.code == 1);
  CHECK(std::any_of(mishap.words.begin(), mishap.words.end(),
                    [&](const std::string& word) { return cut.err.find(word) != std::string::npos; }));
  CHECK(cut.err.find("unicursal resume") != std::string::npos);
}

/// Checks that nothing is left out, and that no more is laid twice than a printer may have planned (20 lines)
/// and received at once (16). Before the first move the print starts again.
void check_continued(const Lines& seen) {
  const Lines& whole = undisturbed().lines;
  const test::Cut place = test::cut_in(seen, whole);
  const auto start = std::find_if(whole.begin(), whole.end(), is_bead) - whole.begin();
  CHECK(place.again <= place.run);
  if (place.again > 0)
    CHECK(place.run - place.again <= 20 + 16);
  else
    CHECK(static_cast<std::ptrdiff_t>(place.run) <= start + 20 + 16);
}

/// Runs `times` prints with the fault, and calls `after` with each.
template <class After>
void suffer(const Mishap& mishap, int times, unsigned seed, After after) {
  const std::size_t lines = undisturbed().lines.size();
  std::mt19937 random(seed);
  for (int done = 0; done < times;) {
    std::vector<std::unique_ptr<Trial>> trials;
    for (; done < times && trials.size() < mishap.at_once; ++done)
      trials.push_back(std::make_unique<Trial>(mishap, 1 + random() % lines));
    for (const auto& trial : trials) trial->cut = trial->host->wait();
    for (const auto& trial : trials) {
      INFO(mishap.kind << " at line " << trial->line << ": " << trial->cut.err);
      after(*trial);
    }
  }
}

/// Returns false if the print was refused, as it may be in the first lines of the part: no place is certain
/// there, and z is not homed again. Also false if a person has to look, since the nozzle was rising at the
/// end.
bool resumed(Trial& trial) {
  const Outcome outcome = trial.bench.resume_anyway();
  INFO(outcome.out << outcome.err);
  if (outcome.code == 2 && outcome.err.find("no certain place") != std::string::npos) {
    const Lines& whole = undisturbed().lines;
    const auto bead = std::find_if(whole.begin(), whole.end(), is_bead) - whole.begin();
    CHECK(static_cast<std::ptrdiff_t>(trial.bench.seen().lines.size()) <= bead + 20 + 16);
    return false;
  }
  if (outcome.code == 2 && outcome.out.find("The nozzle was rising") != std::string::npos) {
    CHECK(outcome.err.find("resume at a terminal") != std::string::npos);
    return false;
  }
  REQUIRE(outcome.code == 0);
  return true;
}

void reset(int times, unsigned seed) {
  const Mishap mishap{"reset", 0, {"has reset itself"}};
  suffer(mishap, times, seed, [&](Trial& trial) {
    check_told(mishap, trial.cut);
    check_kept(trial.bench.print_folder());
    const Outcome asked = test::run(trial.bench.resume());  // nobody answers the question
    const bool anew = asked.code == 0;  // the first lines have done nothing that needs a question
    CHECK((anew || asked.code == 2));
    if (!resumed(trial)) return;
    if (!anew) CHECK(asked.err.find("--yes") != std::string::npos);
    const Seen seen = trial.bench.seen();
    if (anew) CHECK(test::cut_in(seen.lines, undisturbed().lines).again == 0);
    check_continued(seen.lines);
    CHECK(seen.report["layers"].size() == undisturbed().report["layers"].size());
    CHECK(seen.report["extents"]["max"][2] == undisturbed().report["extents"]["max"][2]);
  });
}

void unplug(int times, unsigned seed) {
  // One by one: at a hundredfold speed a printer cools down if it does not hear from its host for 18 s.
  const Mishap mishap{"disconnect:5", 100, {"cable"}, {}, 1};
  suffer(mishap, times, seed, [&](Trial& trial) {
    CHECK(trial.cut.code == 0);  // it has gone on by itself
    CHECK(trial.cut.err.find("cable") != std::string::npos);
    check_equal(trial.bench.seen(), undisturbed());
  });
}

/// A heater that fails very late does no harm, and is not noticed.
void run_cold(int times, unsigned seed) {
  const Mishap mishap{"heaterfail", 100, {"Thermal Runaway", "Heating failed", "MINTEMP"}};
  suffer(mishap, times, seed, [&](Trial& trial) {
    if (trial.cut.code == 0) return check_equal(trial.bench.seen(), undisturbed());
    check_told(mishap, trial.cut);
    check_kept(trial.bench.print_folder());
    trial.bench.replace_printer();
    if (!resumed(trial)) return;
    check_continued(trial.bench.seen().lines);
  });
}

/// One that sticks very late is off by then, or the firmware stops itself, or the host sees it at the end.
void run_hot(int times, unsigned seed) {
  const Mishap mishap{"runaway", 100, {"MAXTEMP", "becomes hotter"}};
  suffer(mishap, times, seed, [&](Trial& trial) {
    check_told(mishap, trial.cut);
    check_kept(trial.bench.print_folder());
    trial.bench.replace_printer();
    if (!resumed(trial)) return;
    check_continued(trial.bench.seen().lines);
  });
}

/// The host gives up long before somebody presses the button, at a hundredfold speed after 90 s.
void fall_silent(int times, unsigned seed) {
  const Mishap mishap{"silence", 100, {"fallen silent"}, {"--fault", "reset@t=9000"}};
  suffer(mishap, times, seed, [&](Trial& trial) {
    check_told(mishap, trial.cut);
    check_kept(trial.bench.print_folder());
    if (!resumed(trial)) return;
    const Seen seen = trial.bench.seen();
    check_continued(seen.lines);
    CHECK(seen.report["extents"]["max"][2] == undisturbed().report["extents"]["max"][2]);
  });
}

}  // namespace

TEST_CASE("after a reset at any line the print is resumed") {
  reset(2, 1);
}

TEST_CASE("a cable that is pulled at any line costs nothing", "[optimised]") {
  unplug(2, 2);
}

TEST_CASE("a heater that fails at any line ends the print, which another printer can resume", "[optimised]") {
  run_cold(2, 3);
}

TEST_CASE("a heater that is stuck on at any line ends the print, which another printer can resume",
          "[optimised]") {
  run_hot(2, 5);
}

TEST_CASE("50 resets", "[long]") {
  reset(50, 11);
}

TEST_CASE("50 cables that are pulled and plugged in again", "[long]") {
  unplug(50, 12);
}

TEST_CASE("50 heaters that fail", "[long]") {
  run_cold(50, 13);
}

TEST_CASE("50 heaters that are stuck on", "[long]") {
  run_hot(50, 15);
}

TEST_CASE("50 printers that fall silent", "[long]") {
  fall_silent(50, 14);
}
