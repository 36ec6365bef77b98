// Prints that are interrupted and resumed: the program is killed, stopped or out of disk, or the printer
// resets. The simulated printer is a process of its own and survives.
#include <poll.h>
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"
#include "tests/host/support/json_events.hpp"
#include "tests/host/support/print_bench.hpp"

using namespace unicursal;
using test::check_equal;
using test::Child;
using test::ends_like;
using test::Outcome;
using test::Seen;
using Bench = test::PrintBench;
namespace fs = std::filesystem;

namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point then) {
  return std::chrono::duration<double>(SteadyClock::now() - then).count();
}

/// An undisturbed print, and its duration since the start of its spool, s.
struct Undisturbed {
  Seen seen;
  double seconds = 0;
};

Undisturbed undisturbed(int speed, const std::string& job = test::sample_job) {
  Bench bench(speed);
  bench.folder().write("job.toml", job);
  Child host(bench.print());
  Bench::wait_for([&] { return bench.begun(); }, host);
  const auto begun = SteadyClock::now();
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return {bench.seen(), seconds_since(begun)};
}

/// Lets the program run for a time, then kills it; returns whether it was still running.
bool kill_after(Child& host, double seconds) {
  const auto begun = SteadyClock::now();
  Bench::wait_for([&] { return seconds_since(begun) >= seconds; }, host);
  const bool running = host.running();
  kill(host.id(), SIGKILL);
  host.wait();
  return running;
}

/// Kills a print `times` times at random moments, perhaps several times in a row.
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
      std::vector<std::string> again = bench.resume();
      again.push_back("--yes");  // a print that had sent nothing asks before it begins
      host = std::make_unique<Child>(again);
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

/// Damage on the line that never makes a damaged line look like a good one, since that cannot be detected.
const std::vector<std::string> garbling{"--fault", "merge:0.002",    "--fault", "falsealarm:0.005",
                                        "--fault", "brokenok:0.005", "--fault", "noise:0.005",
                                        "--fault", "doubleok:0.005"};

}  // namespace

TEST_CASE("a print whose host is killed is resumed, no line is lost or executed twice") {
  kill_and_resume(0, 2, 1);
  kill_and_resume(100, 1, 2);
}

TEST_CASE("the same over a noisy line") {
  kill_and_resume(100, 1, 3, garbling);
}

TEST_CASE("200 kills at random moments do not change the part", "[long]") {
  kill_and_resume(0, 60, 11);
  kill_and_resume(60, 50, 12);
  kill_and_resume(200, 50, 13);
  kill_and_resume(100, 40, 14, garbling);
}

TEST_CASE("a complete print is reported as such, and is listed") {
  Bench bench(0);
  REQUIRE(test::run(bench.print()).code == 0);
  const Outcome outcome = test::run(bench.resume());
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("was completed") != std::string::npos);
  auto list = bench.resume();
  list.push_back("--list");
  CHECK(test::run(list).out.find("completed") != std::string::npos);
}

TEST_CASE("the progress of a resumed print goes on from its layer, and never back") {
  Bench bench(20);
  const std::size_t layers = 6;
  bench.folder().write("job.toml", test::replaced(test::sample_job, "height = 0.4", "height = 1.2"));
  {
    std::vector<std::string> words = bench.print();
    words.push_back("--json");
    Child host(words);
    Bench::wait_for([&] { return host.out().find("\"layer\":3,") != std::string::npos; }, host);
    kill(host.id(), SIGKILL);
    host.wait();
  }
  std::vector<std::string> words = bench.resume();
  words.push_back("--json");
  const Outcome resumed = test::run(words);
  INFO(resumed.err);
  REQUIRE(resumed.code == 0);
  const auto statuses = test::printing_statuses(resumed.out);
  REQUIRE_FALSE(statuses.empty());
  CHECK(statuses.front()["layer"] >= 2);  // the third layer was being laid, or its lines were being sent
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    const nlohmann::json& status = statuses[i];
    CAPTURE(i, status.dump());
    CHECK(status["layers"] == layers);
    CHECK(status["percent"] <= 100);
    if (i == 0) continue;
    CHECK(status["layer"] >= statuses[i - 1]["layer"]);
    CHECK(status["percent"] >= statuses[i - 1]["percent"].get<double>() - 1);  // later layers are estimates
  }
}

TEST_CASE("after a reset the print continues at the last certain place, if the user agrees") {
  const Seen whole = undisturbed(0).seen;
  const std::string line = "700";
  Bench bench(0, {"--fault", "reset@line=" + line});
  const Outcome cut = test::run(bench.print());
  INFO(cut.err);
  REQUIRE(cut.code == 1);
  CHECK(cut.err.find("unicursal resume") != std::string::npos);
  const Outcome asked = test::run(bench.resume());  // nobody answers the question
  CHECK(asked.code == 2);
  CHECK(asked.out.find("continues in layer") != std::string::npos);
  CHECK(asked.err.find("--yes") != std::string::npos);
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const Seen seen = bench.seen();
  // Nothing is left out, and at most the moves that the printer may have planned are laid twice.
  const auto lead_in = std::find(seen.lines.begin() + 5, seen.lines.end(), "G28 X Y");
  REQUIRE(lead_in != seen.lines.end());
  const test::Cut place = test::cut_in(seen.lines, whole.lines);
  CHECK(place.again <= place.run);
  CHECK(place.run - place.again <= 20 + 16);
  // Every layer has its height: z was found again.
  REQUIRE(seen.report["layers"].size() == whole.report["layers"].size());
  CHECK(seen.report["extents"]["max"][2] == whole.report["extents"]["max"][2]);
}

TEST_CASE("a stop while a lost printer heats again moves nothing, and the print can still be resumed") {
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

TEST_CASE("a resumed print names the job's mixtures, with feeders that slip as well") {
  // In the middle of a zone: near its borders mixtures are sent that the job does not name.
  Bench bench(0, {"--fault", "reset@line=800"});
  bench.folder().write("bench.toml", std::string(test::sample_profile) + "flow_factors = [1, 1.05, 1]\n");
  REQUIRE(test::run(bench.print()).code == 1);
  std::vector<std::string> resume = bench.resume();
  resume.insert(resume.end(), {"--yes", "--json"});
  const Outcome outcome = test::run(resume);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const std::set<std::string> named = test::mixtures_named(outcome.out);
  CHECK_FALSE(named.empty());
  for (const std::string& mixture : named) CHECK((mixture == "sea" || mixture == "sun"));
}

TEST_CASE("a cable that was pulled and plugged in again costs nothing") {
  const Seen whole = undisturbed(100).seen;
  Bench bench(100, {"--fault", "disconnect:100@line=700"});  // a second
  const Outcome outcome = test::run(bench.print());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.find("cable") != std::string::npos);
  CHECK(outcome.err.find("the printer is back") != std::string::npos);
  check_equal(bench.seen(), whole);
}

TEST_CASE("a print whose printer comes back without knowing it ends, and can be resumed") {
  const Seen whole = undisturbed(100).seen;
  Bench bench(100, {"--fault", "disconnect@line=700"});
  Child host(bench.print());
  Bench::wait_for([&] { return host.err().find("when it is back") != std::string::npos; }, host);
  REQUIRE(host.running());
  bench.replace_printer();
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("the print cannot simply go on") != std::string::npos);
  CHECK(outcome.err.find("unicursal resume") != std::string::npos);
  REQUIRE(bench.resume_anyway().code == 0);
  const Seen seen = bench.seen();
  CHECK(std::count(seen.lines.begin(), seen.lines.end(), "G28 X Y") == 1);
  CHECK(ends_like(seen.lines, whole.lines, 750));
}

TEST_CASE("a signal ends the waiting for a printer whose cable was pulled") {
  Bench bench(100, {"--fault", "disconnect@line=700"});
  Child host(bench.print());
  Bench::wait_for([&] { return host.err().find("when it is back") != std::string::npos; }, host);
  REQUIRE(host.running());
  kill(host.id(), SIGTERM);
  Bench::wait_for([&] { return host.err().find("heaters are switched off when") != std::string::npos; },
                  host);
  kill(host.id(), SIGTERM);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("it may still be hot") != std::string::npos);
  CHECK(outcome.err.find("unicursal resume") != std::string::npos);
}

TEST_CASE("a print that is stopped while its cable is out is cooled when it is back") {
  Bench bench(100, {"--fault", "disconnect:300@line=700"});
  Child host(bench.print());
  Bench::wait_for([&] { return host.err().find("when it is back") != std::string::npos; }, host);
  kill(host.id(), SIGINT);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  const std::string lines = test::read_text(bench.path("t.txt"));
  const std::size_t cooled = lines.rfind("M104 S0\nM140 S0\n");
  REQUIRE(cooled != std::string::npos);
  CHECK(lines.find("G1 ", cooled) == std::string::npos);
}

TEST_CASE("a stopped print whose cable is pulled is cooled when it is back, and does not go on") {
  Bench bench(100, {"--fault", "disconnect:100@command=M400"},
              test::tall_profile() + "[gcode]\nend = \"M400\"\n");
  bench.folder().write("job.toml", test::tall_job());
  Child host(bench.print());
  const auto lines = [&] { return test::read_text(bench.path("t.txt")); };
  Bench::wait_for([&] { return lines().find("G1 X") != std::string::npos; }, host);
  kill(host.id(), SIGINT);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("the heaters are switched off when it is back") != std::string::npos);
  const std::string all = lines();
  const std::size_t back = all.find("M115", all.find("M400"));
  CHECK(all.find("M104 S0\nM140 S0\n", back) != std::string::npos);
  CHECK(all.find(" E.", all.find("M104 S0")) == std::string::npos);  // nothing is laid any more
}

TEST_CASE("a print whose host dies while the nozzle is aside continues at its height") {
  const Seen whole = undisturbed(0).seen;
  Bench bench(0, {"--fault", "say://action:pause@line=700"});
  Child host(bench.print());
  Bench::wait_for([&] { return bench.begun(); }, host);
  const auto journal = [&] { return host::read_journal(bench.print_folder() / "journal"); };
  Bench::wait_for([&] { return journal().aside; }, host);
  REQUIRE(host.running());
  kill(host.id(), SIGKILL);
  host.wait();
  const std::uint64_t held = journal().handed;
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const Seen seen = bench.seen();
  CHECK(ends_like(seen.lines, whole.lines, held));
  CHECK(seen.report["layers"].size() == whole.report["layers"].size());
  CHECK(seen.report["extents"]["max"][2] == whole.report["extents"]["max"][2]);
}

TEST_CASE("a print that was stopped and parked can be resumed") {
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

TEST_CASE("a print is resumed with its original job, even if the files have changed") {
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

TEST_CASE("if the disk is full, the print waits until there is room") {
  const Seen expected = undisturbed(0).seen;
  Bench bench(0);
  Child host(bench.print());
  // To the program, a limit on the size of files looks like a full disk.
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

TEST_CASE("if the disk stays full, the nozzle does not stay on the part", "[optimised]") {
  const std::string tall = test::replaced(test::sample_job, "height = 0.4", "height = 2.0");
  const std::vector<std::string> whole = undisturbed(0, tall).seen.lines;
  Bench bench(0);
  bench.folder().write("job.toml", tall);
  Child host(bench.print());
  const auto laying = [&] {
    return bench.begun() && host::read_journal(bench.print_folder() / "journal").acknowledged > 300;
  };
  Bench::wait_for(laying, host);
  const rlimit full{fs::file_size(bench.print_folder() / "chunks"), RLIM_INFINITY};
  const rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &full, nullptr) == 0);
  Bench::wait_for([&] { return host.err().find("paused: ") != std::string::npos; }, host);
  CHECK(host.err().find("make room", host.err().find("paused: ")) != std::string::npos);
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &room, nullptr) == 0);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  // No line of the print is lost or executed twice, and the lines in between led the nozzle aside and back.
  const std::vector<std::string> lines = bench.seen().lines;
  const test::Cut place = test::cut_in(lines, whole);
  CHECK(place.again == place.run);
  const auto aside = lines.begin() + static_cast<std::ptrdiff_t>(place.run);
  const auto still = std::find(aside, lines.end(), "M400");
  REQUIRE(still != lines.end());
  CHECK((still - 1)->rfind("G0 X5 Y5", 0) == 0);
}

TEST_CASE("after a new print on the same printer the previous one cannot be resumed") {
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
  CHECK(outcome.err.find("another print has begun") != std::string::npos);
}

TEST_CASE("a damaged record of a print is refused with a message") {
  Bench bench(0);
  REQUIRE(test::run(bench.print()).code == 0);
  const fs::path record = bench.print_folder() / "print.json";
  const std::string sound = test::read_text(record);
  for (const std::string& text :
       {std::string("{"), std::string("[]"), test::replaced(sound, "\"format\": 3", "\"format\": 4"),
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
