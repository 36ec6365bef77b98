// Prints that are cut short, and go on: the program itself, killed, stopped, out of disk, or with a printer
// that resets; the simulated printer is a process of its own and lives on.
#include <poll.h>
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "host/spool/chunk_reader.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using nlohmann::json;
using test::Child;
using test::Outcome;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// What a simulated printer has run and laid.
struct Seen {
  std::vector<std::string> lines;  ///< without the hosts' questions
  json report;
};

/// A job, a printer of its own, and the folder in which its prints are kept.
class Bench {
 public:
  /// `speed`: printer seconds per second; 0: as fast as lines come.
  explicit Bench(int speed, const std::vector<std::string>& more = {}) {
    folder_.write("bench.toml", test::sample_profile);
    folder_.write("plate.svg", test::sample_drawing);
    folder_.write("job.toml", test::sample_job);
    std::vector<std::string> arguments{"simulate",    "--profile", path("bench.toml"),    "--link",
                                       path("port"),  "--speed",   std::to_string(speed), "--transcript",
                                       path("t.txt"), "--report",  path("seen.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    printer_ = std::make_unique<Child>(arguments);
    wait_for([&] { return fs::exists(path("port")); }, *printer_);
  }

  std::string path(const std::string& name) const { return folder_ / name; }
  const test::TempFolder& folder() const { return folder_; }
  /// Planned in no hurry, so that two prints of the job are alike on a busy computer as well.
  std::vector<std::string> print(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"print",   path("job.toml"), "--port",        path("port"),
                                   "--spool", path("spool"),    "--full-quality"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::vector<std::string> resume() const { return {"resume", "--spool", path("spool")}; }
  Outcome resume_anyway() const {
    auto arguments = resume();
    arguments.push_back("--yes");
    return test::run(arguments);
  }
  /// Whether a print has been begun, as far as its folder tells.
  bool begun() const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(path("spool"), none)) {
      if (fs::exists(entry.path() / "print.json")) return true;
    }
    return false;
  }
  fs::path print_folder() const { return fs::directory_iterator(path("spool"))->path(); }

  /// Ends the printer.
  Seen seen() {
    kill(printer_->id(), SIGTERM);
    CHECK(printer_->wait().code == 0);
    Seen seen;
    std::istringstream transcript(test::read_text(path("t.txt")));
    for (std::string line; std::getline(transcript, line);) {
      const bool question = line == "M115" || line == "M105" || line == "M114" ||
                            line.rfind("M155", 0) == 0 || line.rfind("M110", 0) == 0;
      if (!question) seen.lines.push_back(line);
    }
    seen.report = json::parse(test::read_text(path("seen.json")));
    return seen;
  }

  template <class Condition>
  static void wait_for(Condition condition, const Child& child) {
    while (!condition() && child.running()) poll(nullptr, 0, 2);
  }

 private:
  test::TempFolder folder_;
  std::unique_ptr<Child> printer_;
};

/// An undisturbed print, and how long it took from its spool's beginning, s.
struct Undisturbed {
  Seen seen;
  double seconds = 0;
};

Undisturbed undisturbed(int speed, const std::vector<std::string>& more = {}) {
  Bench bench(speed);
  Child host(bench.print(more));
  Bench::wait_for([&] { return bench.begun(); }, host);
  const auto begun = Clock::now();
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return {bench.seen(), seconds_since(begun)};
}

/// Lets the program run for so long, then kills it; whether it had still been running.
bool kill_after(Child& host, double seconds) {
  const auto begun = Clock::now();
  Bench::wait_for([&] { return seconds_since(begun) >= seconds; }, host);
  const bool running = host.running();
  kill(host.id(), SIGKILL);
  host.wait();
  return running;
}

void check_equal(const Seen& seen, const Seen& expected) {
  CHECK((seen.lines == expected.lines));
  for (const char* figure : {"extruded_mm", "feeders", "deposited_length_mm"}) {
    INFO(figure);
    CHECK(seen.report[figure] == expected.report[figure]);
  }
  CHECK(seen.report["chamber"]["fed_mm3"] == expected.report["chamber"]["fed_mm3"]);
  CHECK(seen.report["deposited_mm3"].get<double>() ==
        Approx(expected.report["deposited_mm3"].get<double>()).epsilon(1e-9));
}

/// Kills a print `times` times at random moments, several times in a row when chance will have it so.
void kill_and_resume(int speed, int times, std::uint64_t seed, const std::vector<std::string>& faults = {}) {
  const Undisturbed expected = undisturbed(speed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> moment(0, expected.seconds);
  for (int kills = 0; kills < times;) {
    Bench bench(speed, faults);
    auto host = std::make_unique<Child>(bench.print());
    Bench::wait_for([&] { return bench.begun(); }, *host);
    for (bool first = true; first || (random() % 4 == 0 && kills < times); first = false) {
      if (!kill_after(*host, moment(random))) break;
      ++kills;
      host = std::make_unique<Child>(bench.resume());
    }
    const Outcome outcome = bench.resume_anyway();
    INFO("kill " << kills << " of seed " << seed << " at speed " << speed << ": " << outcome.out
                 << outcome.err);
    const bool busy = outcome.err.find("another program") != std::string::npos;
    REQUIRE((outcome.code == 0 || busy));
    if (busy) REQUIRE(host->wait().code == 0);
    check_equal(bench.seen(), expected.seen);
  }
}

/// What a line may do to bytes without a damaged line being taken for a good one, which nobody could see.
const std::vector<std::string> garbling{"--fault", "merge:0.002",    "--fault", "falsealarm:0.005",
                                        "--fault", "brokenok:0.005", "--fault", "noise:0.005",
                                        "--fault", "doubleok:0.005"};

/// The lines that follow the last one of `seen` that begins the print anew, compared with the end of a print.
bool ends_like(const std::vector<std::string>& seen, const std::vector<std::string>& whole,
               std::size_t from) {
  const std::size_t count = whole.size() - from;
  return seen.size() >= count && std::equal(whole.begin() + static_cast<std::ptrdiff_t>(from), whole.end(),
                                            seen.end() - static_cast<std::ptrdiff_t>(count));
}

}  // namespace

TEST_CASE("a print whose host is killed goes on, nothing lost and nothing twice") {
  kill_and_resume(0, 2, 1);
  kill_and_resume(100, 3, 2);
}

TEST_CASE("the same over a line that garbles what passes") {
  kill_and_resume(100, 3, 3, garbling);
}

TEST_CASE("a print goes on in the way that the command line had asked for") {
  const std::vector<std::string> asked{"--no-look-ahead"};
  const Undisturbed expected = undisturbed(100, asked);
  Bench bench(100);
  Child host(bench.print(asked));
  Bench::wait_for([&] { return bench.begun(); }, host);
  REQUIRE(kill_after(host, expected.seconds / 3));
  const Outcome outcome = bench.resume_anyway();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  check_equal(bench.seen(), expected.seen);
}

TEST_CASE("200 kills at random moments leave the part as it would have been", "[long]") {
  kill_and_resume(0, 60, 11);
  kill_and_resume(60, 50, 12);
  kill_and_resume(200, 50, 13);
  kill_and_resume(100, 40, 14, garbling);
}

TEST_CASE("a print that is complete says so, and is listed") {
  Bench bench(0);
  REQUIRE(test::run(bench.print()).code == 0);
  const Outcome outcome = test::run(bench.resume());
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("was completed") != std::string::npos);
  auto list = bench.resume();
  list.push_back("--list");
  CHECK(test::run(list).out.find("completed") != std::string::npos);
}

TEST_CASE("after a reset the print goes on at the last place that is certain, if one agrees") {
  const Seen whole = undisturbed(0).seen;
  const std::string line = "700";
  Bench bench(0, {"--fault", "reset@line=" + line});
  const Outcome cut = test::run(bench.print());
  INFO(cut.err);
  REQUIRE(cut.code == 1);
  CHECK(cut.err.find("unicursal resume") != std::string::npos);
  const Outcome asked = test::run(bench.resume());  // with nobody to answer
  CHECK(asked.code == 2);
  CHECK(asked.out.find("goes on in layer") != std::string::npos);
  CHECK(asked.err.find("--yes") != std::string::npos);
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const Seen seen = bench.seen();
  // At most what the printer may have planned is laid twice, and nothing is left out.
  const auto lead_in = std::find(seen.lines.begin() + 5, seen.lines.end(), "G28 X Y");
  REQUIRE(lead_in != seen.lines.end());
  std::size_t again = whole.lines.size();
  while (again > 0 && ends_like(seen.lines, whole.lines, again - 1)) --again;
  const auto run_before = static_cast<std::size_t>(
      std::mismatch(seen.lines.begin(), seen.lines.end(), whole.lines.begin(), whole.lines.end()).first -
      seen.lines.begin());
  CHECK(again <= run_before);
  CHECK(run_before - again <= 20 + 16);
  // Every layer is as high as it was to be: z was found again.
  REQUIRE(seen.report["layers"].size() == whole.report["layers"].size());
  CHECK(seen.report["extents"]["max"][2] == whole.report["extents"]["max"][2]);
}

TEST_CASE("a stop while a lost printer heats again moves nothing, and the print can still go on") {
  const Seen whole = undisturbed(0).seen;
  Bench bench(50, {"--fault", "reset@line=700"});
  REQUIRE(test::run(bench.print()).code == 1);
  auto arguments = bench.resume();
  arguments.push_back("--yes");
  Child child(arguments);
  const auto heating = [&] {
    const host::JournalState state = host::read_journal(bench.print_folder() / "journal");
    return state.legs == 2 && state.handed > 0;
  };
  Bench::wait_for(heating, child);
  kill(child.id(), SIGINT);
  const Outcome stopped = child.wait();
  INFO(stopped.out << stopped.err);
  REQUIRE(stopped.code == 3);
  CHECK(stopped.out.find("parked and cooling") == std::string::npos);
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const Seen seen = bench.seen();
  CHECK(std::count(seen.lines.begin(), seen.lines.end(), "G28 X Y") == 1);
  CHECK(ends_like(seen.lines, whole.lines, 750));
  CHECK(seen.report["extents"]["max"][2] == whole.report["extents"]["max"][2]);
}

TEST_CASE("a cable that was pulled and put back costs nothing") {
  const Seen whole = undisturbed(100).seen;
  Bench bench(100, {"--fault", "disconnect:5@line=700"});
  const Outcome cut = test::run(bench.print());
  INFO(cut.err);
  REQUIRE(cut.code == 1);
  CHECK(cut.err.find("cable") != std::string::npos);
  const auto plugged_in = [&] { return fs::exists(bench.path("port")); };
  while (!plugged_in()) poll(nullptr, 0, 5);
  const Outcome resumed = test::run(bench.resume());
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  check_equal(bench.seen(), whole);
}

TEST_CASE("a print that was stopped and parked can be taken up again") {
  const Seen whole = undisturbed(0).seen;
  Bench bench(100);
  Child child(bench.print());
  const auto laying = [&] {
    return bench.begun() && host::read_journal(bench.print_folder() / "journal").acknowledged > 200;
  };
  Bench::wait_for(laying, child);
  kill(child.id(), SIGINT);
  const Outcome stopped = child.wait();
  INFO(stopped.err);
  REQUIRE(stopped.code == 3);
  REQUIRE(stopped.out.find("parked") != std::string::npos);
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const Seen seen = bench.seen();
  CHECK(ends_like(seen.lines, whole.lines, whole.lines.size() - 500));
  CHECK(seen.report["extents"]["max"][2] == whole.report["extents"]["max"][2]);
}

TEST_CASE("a print goes on with the job it was begun with, whatever has become of the files") {
  const Undisturbed expected = undisturbed(100);
  Bench bench(100);
  Child host(bench.print());
  Bench::wait_for([&] { return bench.begun(); }, host);
  REQUIRE(kill_after(host, expected.seconds / 3));
  bench.folder().write("job.toml", "no job any more");
  fs::remove(bench.path("plate.svg"));
  fs::remove(bench.path("bench.toml"));
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.err);
  REQUIRE(resumed.code == 0);
  check_equal(bench.seen(), expected.seen);
}

TEST_CASE("when the disk is full the print waits, and goes on when there is room") {
  const Seen expected = undisturbed(0).seen;
  Bench bench(0);
  Child host(bench.print());
  // A limit on the size of files is a full disk to the program that it is put on.
  const rlimit full{20000, RLIM_INFINITY}, room{RLIM_INFINITY, RLIM_INFINITY};
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &full, nullptr) == 0);
  Bench::wait_for([&] { return host.err().find("make room") != std::string::npos; }, host);
  REQUIRE(host.running());
  const Outcome meanwhile = test::run(bench.resume());
  CHECK(meanwhile.err.find("another program") != std::string::npos);
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &room, nullptr) == 0);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  check_equal(bench.seen(), expected);
}

TEST_CASE("a new print on the same printer ends the chance to resume the one before") {
  const double seconds = undisturbed(100).seconds;
  Bench bench(100);
  {
    Child host(bench.print());
    Bench::wait_for([&] { return bench.begun(); }, host);
    REQUIRE(kill_after(host, seconds / 3));
  }
  const std::string first = bench.print_folder().filename().string();
  REQUIRE(test::run(bench.print()).code == 0);
  auto arguments = bench.resume();
  arguments.push_back(first);
  const Outcome outcome = test::run(arguments);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("another print was begun") != std::string::npos);
}

TEST_CASE("a damaged record of a print is refused in words") {
  Bench bench(0);
  REQUIRE(test::run(bench.print()).code == 0);
  const fs::path record = bench.print_folder() / "print.json";
  const std::string sound = test::read_text(record);
  for (const std::string& text :
       {std::string("{"), std::string("[]"), test::replaced(sound, "\"format\": 1", "\"format\": 2"),
        test::replaced(sound, "\"port\"", "\"pot\"")}) {
    std::ofstream(record) << text;
    const Outcome outcome = test::run(bench.resume());
    INFO(text << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("print.json") != std::string::npos);
  }
  std::ofstream(record) << sound;
  fs::remove(bench.print_folder() / "journal");
  const Outcome outcome = test::run(bench.resume());
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("journal") != std::string::npos);
}
