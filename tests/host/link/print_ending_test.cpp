// How `unicursal print` ends when the printer fails or the user stops it: the program itself, and a
// printer that misbehaves on demand.
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "fake_printer.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using nlohmann::json;
using test::FakePrinter;
using test::Outcome;

namespace {

struct SmallJob {
  SmallJob() {
    folder.write("bench.toml", test::sample_profile);
    folder.write("plate.svg", test::sample_drawing);
    file = folder.write("job.toml", test::sample_job).string();
  }
  std::vector<std::string> print_on(const FakePrinter& printer) const {
    return {"print", file, "--port", printer.path(), "--report", (folder / "r.json").string()};
  }
  json report() const { return json::parse(test::read_text(folder / "r.json")); }

  test::TempFolder folder;
  std::string file;
};

bool holds(const std::vector<std::string>& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

}  // namespace

TEST_CASE("a print that fails leaves a report with the reason") {
  const SmallJob job;
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 60) p.forget_numbers(), p.reply("start");
    return n == 60;
  }});
  const Outcome outcome = test::run(job.print_on(printer));
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  const json report = job.report();
  CHECK(report["ended"] == "failed");
  CHECK(report["reason"].get<std::string>().find("reset itself") != std::string::npos);
  CHECK(report["link"]["acknowledged"].get<int>() <= 61);  // two M105 are not among the printer's 60
}

TEST_CASE("a print that never began is not kept, and the user is not asked to resume it") {
  const SmallJob job;
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t, const std::string&) {
    p.reply("Error:Printer halted. kill() called!");
    return true;
  }});
  auto command = job.print_on(printer);
  const std::filesystem::path kept = job.folder / "spool";
  command.insert(command.end(), {"--spool", kept.string()});
  const Outcome outcome = test::run(command);
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("halted") != std::string::npos);
  CHECK(outcome.err.find("unicursal resume") == std::string::npos);
  CHECK(std::filesystem::is_empty(kept));
}

TEST_CASE("a stop while heating ends the heating, and does not claim to have parked") {
  const int signal = GENERATE(SIGINT, SIGQUIT, SIGHUP);
  CAPTURE(signal);
  const SmallJob job;
  std::atomic<bool> heating = false;
  bool waits = false;
  std::string heard;
  FakePrinter printer({.inwards =
                           [&](std::string line) {
                             heard += line;
                             return line;
                           },
                       .instead =
                           [&](FakePrinter&, std::size_t, const std::string& command) {
                             if (command.rfind("M109", 0) != 0) return false;
                             return waits = true;
                           },
                       .on_tick =
                           [&](FakePrinter& p) {
                             if (!waits) return;
                             waits = heard.find("\nM108\n") == std::string::npos;
                             p.reply(waits ? " T:24.1 /210.0 B:23.9 /60.0 @:127 W:?" : "ok");
                             heating = true;
                           }});
  test::Child host(job.print_on(printer));
  while (!heating) {
    REQUIRE(host.running());
    poll(nullptr, 0, 20);
  }
  for (const int idle : {SIGUSR1, SIGUSR2, SIGTSTP}) kill(host.id(), idle);
  kill(host.id(), signal);
  const Outcome outcome = host.wait();
  printer.stop();
  INFO(outcome.err << outcome.out);
  CHECK(outcome.code == 3);
  CHECK(job.report()["ended"] == "stopped");
  CHECK(outcome.out.find("parked") == std::string::npos);
  CHECK(holds(printer.executed(), "M104 S0"));
  CHECK(holds(printer.executed(), "M140 S0"));
  for (const std::string& line : printer.executed()) CHECK(line.rfind("G1", 0) != 0);
}
