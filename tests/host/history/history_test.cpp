// What `unicursal history` shows of real prints.
#include "host/history/history.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tests/host/support/print_bench.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::Outcome;
using test::PrintBench;
using test::replaced;

const std::string priced_profile = replaced(test::sample_profile, "feeders = 3\n", "") +
                                   "[[filament]]\nname = \"sea\"\nprice = 20\n[[filament]]\nname = "
                                   "\"sun\"\nmaterial = \"PETG\"\nprice = 30\n"
                                   "[[filament]]\nname = \"sky\"\nprice = 25\n";

json history_of(const PrintBench& bench) {
  const Outcome outcome = test::run({"history", "--spool", bench.path("spool"), "--json"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  return json::parse(outcome.out);
}

/// The rows hold what the feeders of the bench's printers have turned, to half a per cent or `margin` in m.
void check_fed(const json& history, const json& feeders, double margin = 0) {
  REQUIRE(history["filaments"].size() == 3);
  for (std::size_t f = 0; f < 3; ++f) {
    const double mm = feeders[f]["mm"];
    const json& spent = history["filaments"][f];
    CHECK(spent["metres"].get<double>() == Approx(mm / 1000).epsilon(0.005).margin(margin));
    const double density = f == 1 ? 1.27 : 1.24;
    CHECK(
        spent["grams"].get<double>() ==
        Approx(mm / 1000 * std::numbers::pi / 4 * 1.75 * 1.75 * density).epsilon(0.005).margin(margin * 3.1));
  }
}

}  // namespace

TEST_CASE("The history of prints has the filament that the printer's feeders have fed") {
  PrintBench bench(0, {}, priced_profile);
  CHECK(history_of(bench)["prints"].empty());
  for (int i = 0; i < 2; ++i) REQUIRE(test::run(bench.print({"--quiet"})).code == 0);
  const json history = history_of(bench);
  REQUIRE(history["prints"].size() == 2);
  check_fed(history, bench.seen().report["feeders"]);
  CHECK(history["filaments"][1]["prints"] == 2);
  const json& print = history["prints"][0];
  CHECK(print["ended"] == "completed");
  CHECK(print["job"] == "job");
  CHECK(print["layers_done"] == print["layers"]);
  CHECK(print["seconds"].get<double>() > 0);
  CHECK(print["foretold_seconds"].get<double>() > 10);
  CHECK(print["ended_at"] >= print["began"]);
  CHECK(print["filaments"][2]["feeder"] == 3);
  const Outcome words = test::run({"history", "--spool", bench.path("spool")});
  CHECK(words.out.find("sun (PETG, #d63430): ") != std::string::npos);
  CHECK(words.out.find(" EUR in 2 prints") != std::string::npos);
}

TEST_CASE("A print that is killed and resumed on a cold printer is one row with the purge of its restart",
          "[optimised]") {
  PrintBench bench(0, {"--fault", "reset@line=250"}, priced_profile);
  REQUIRE(test::run(bench.print({"--quiet"})).code == 1);
  const json failed = history_of(bench);
  REQUIRE(failed["prints"].size() == 1);
  CHECK(failed["prints"][0]["ended"] == "failed");
  CHECK_FALSE(failed["prints"][0]["reason"].get<std::string>().empty());
  CHECK(failed["prints"][0]["layers_done"] < failed["prints"][0]["layers"]);
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  const json history = history_of(bench);
  REQUIRE(history["prints"].size() == 1);
  const json& print = history["prints"][0];
  CHECK(print["ended"] == "completed");
  CHECK(print["id"] == failed["prints"][0]["id"]);
  CHECK(print["began"] == failed["prints"][0]["began"]);
  CHECK(print["foretold_seconds"] == failed["prints"][0]["foretold_seconds"]);
  CHECK(print["seconds"] > failed["prints"][0]["seconds"]);
  // The board has forgotten its mixture: what it moves before the next one comes from other feeders.
  check_fed(history, bench.seen().report["feeders"], 0.001);
}

TEST_CASE("A print can be given a note and be removed from the history, and a spreadsheet reads the rest") {
  PrintBench bench(0, {}, priced_profile);
  REQUIRE(test::run(bench.print({"--quiet"})).code == 0);
  const std::string spool = bench.path("spool");
  const std::string note = "=2+3, \"good\"\nand more";
  REQUIRE(test::run({"history", "--spool", spool, "1", "--note", note}).code == 0);
  CHECK(history_of(bench)["prints"][0]["note"] == note);
  bench.folder().write("read.py",
                       "import csv, json, sys\n"
                       "print(json.dumps(list(csv.DictReader(sys.stdin, strict=True))))\n");
  bench.folder().write("table.csv", test::run({"history", "--spool", spool, "--csv"}).out);
  const std::string words =
      "python3 " + bench.path("read.py") + " < " + bench.path("table.csv") + " > " + bench.path("table.json");
  REQUIRE(std::system(words.c_str()) == 0);
  const json table = json::parse(test::read_text(bench.path("table.json")));
  REQUIRE(table.size() == 3);
  CHECK(table[1]["filament"] == "sun");
  CHECK(table[1]["note"] == "'" + note);
  CHECK(std::stod(table[1]["grams"].get<std::string>()) ==
        Approx(history_of(bench)["prints"][0]["filaments"][1]["grams"].get<double>()).margin(0.001));
  CHECK(test::run({"history", "--spool", spool, "--remove", "2"}).code == 2);
  REQUIRE(test::run({"history", "--spool", spool, "--remove", "1"}).code == 0);
  CHECK(history_of(bench)["prints"].empty());
  CHECK(history_of(bench)["filaments"].empty());
}

}  // namespace unicursal
