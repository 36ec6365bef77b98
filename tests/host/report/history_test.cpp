// What `unicursal history` shows of real prints.
#include "host/report/history.hpp"

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

const std::string profile = replaced(test::sample_profile, "feeders = 3\n", "") +
                            "[[filament]]\nname = \"sea\"\nprice = 20\n[[filament]]\nname = "
                            "\"sun\"\nmaterial = \"PETG\"\nprice = 30\n"
                            "[[filament]]\nname = \"sky\"\nprice = 25\n";

json history_of(const PrintBench& bench) {
  const Outcome outcome = test::run({"history", "--spool", bench.path("spool"), "--json"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("The history of prints has the filament that the printer's feeders have fed") {
  PrintBench bench(0, {}, profile);
  CHECK(history_of(bench)["prints"].empty());
  for (int i = 0; i < 2; ++i) REQUIRE(test::run(bench.print({"--quiet"})).code == 0);
  const json history = history_of(bench);
  REQUIRE(history["prints"].size() == 2);
  REQUIRE(history["filaments"].size() == 3);
  const json seen = bench.seen().report;
  double grams = 0;
  for (std::size_t f = 0; f < 3; ++f) {
    // Both prints were made by this printer.
    const double mm = seen["feeders"][f]["mm"];
    const json& spent = history["filaments"][f];
    CHECK(spent["prints"] == 2);
    CHECK(spent["metres"].get<double>() == Approx(mm / 1000).epsilon(0.005));
    const double density = f == 1 ? 1.27 : 1.24;
    CHECK(spent["grams"].get<double>() ==
          Approx(mm / 1000 * std::numbers::pi / 4 * 1.75 * 1.75 * density).epsilon(0.005));
    grams += history["prints"][0]["filaments"][f]["grams"].get<double>();
  }
  CHECK(history["prints"][0]["ended"] == "completed");
  CHECK(grams > 0);
  const Outcome words = test::run({"history", "--spool", bench.path("spool")});
  CHECK(words.out.find("sun (PETG, #d63430): ") != std::string::npos);
  CHECK(words.out.find(" EUR in 2 prints") != std::string::npos);
}

TEST_CASE("A history with damaged lines keeps the others, and a print that was resumed counts once") {
  const test::TempFolder folder;
  const std::string sound = R"({"print":"a","ended":"stopped","currency":"EUR","filaments":[]})";
  folder.write("history", sound + "\n{\"print\":3}\nrubbish\n" + std::string(100000, 'x') + "\n" +
                              replaced(sound, "stopped", "completed") + "\n" + sound.substr(0, 20));
  const auto prints = host::history(folder.path());
  REQUIRE(prints.size() == 1);
  CHECK(prints[0].ended == "completed");
}

}  // namespace unicursal
