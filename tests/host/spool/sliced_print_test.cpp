// Prints of a slicer's G-code: whole, cut short, and resumed.
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "host/spool/chunk_reader.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/json_events.hpp"
#include "tests/host/support/print_bench.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::Child;
using test::Outcome;
using test::Seen;
using Bench = test::PrintBench;
namespace fs = std::filesystem;

namespace {

constexpr const char* job = R"(printer = "bench.toml"

[part]
file = "block.gcode"

[[zone]]
select = "T0"
mixture = "sea"

[[zone]]
select = "T1"
mixture = "sun"

[mixture]
sea = [1.0, 0.0, 0.0]
sun = [0.0, 1.0, 1.0]
)";

constexpr std::size_t layers = 16;

std::string block(std::size_t height = layers) {
  gcode::test::BlockOptions options;
  options.layers = height;
  return gcode::test::sliced_block(options).text;
}

/// A bench whose job is a sliced block.
class SlicedBench : public Bench {
 public:
  explicit SlicedBench(int speed, const std::vector<std::string>& more = {}) : Bench(speed, more) {
    folder().write("block.gcode", block());
    folder().write("job.toml", job);
  }
};

Seen undisturbed() {
  SlicedBench bench(0);
  const Outcome outcome = test::run(bench.print());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return bench.seen();
}

/// Whether the print is in the middle: in a layer from the third to the last but two.
bool is_in_the_middle(const std::string& events) {
  for (std::size_t layer = 3; layer + 2 <= layers; ++layer) {
    if (events.find("\"layer\":" + std::to_string(layer) + ",") != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("A slicer's G-code whose host is killed is resumed with the next line, from its copy",
          "[optimised]") {
  const Seen whole = undisturbed();
  CHECK(std::count_if(whole.lines.begin(), whole.lines.end(), [](const std::string& line) {
          return line.starts_with("G1 ") || line.starts_with("G0 ");
        }) > 200);
  SlicedBench bench(60);
  std::vector<std::string> words = bench.print();
  words.emplace_back("--json");
  {
    Child host(words);
    Bench::wait_for([&] { return is_in_the_middle(host.out()); }, host);
    REQUIRE(host.running());
    kill(host.id(), SIGKILL);
    host.wait();
  }
  bench.folder().write("block.gcode", "G28\n");  // the copy counts
  std::vector<std::string> again = bench.resume();
  again.emplace_back("--json");
  const Outcome resumed = test::run(again);
  INFO(resumed.err);
  REQUIRE(resumed.code == 0);
  const auto statuses = test::printing_statuses(resumed.out);
  REQUIRE_FALSE(statuses.empty());
  CHECK(statuses.front()["layer"] >= 2);
  CHECK(statuses.back()["layers"] == layers);
  test::check_equal(bench.seen(), whole);
}

TEST_CASE("After a reset a slicer's G-code goes on at its last certain line behind a lead-in") {
  const Seen whole = undisturbed();
  SlicedBench bench(0, {"--fault", "reset@line=200"});
  const Outcome cut = test::run(bench.print());
  INFO(cut.err);
  REQUIRE(cut.code == 1);
  CHECK_THAT(cut.err, Contains("unicursal resume"));
  bench.replace_printer();
  const Outcome resumed = bench.resume_anyway();
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  CHECK_THAT(resumed.out, Contains("of 16, at z ="));
  const Seen seen = bench.seen();
  const test::Cut where = test::cut_in(seen.lines, whole.lines);
  CHECK(where.again <= where.run);       // no line is lost
  CHECK(where.again + 30 >= where.run);  // and few are repeated
  CHECK(where.again > 0);
}

TEST_CASE(
    "A slicer's G-code that is stopped in the middle parks above the part, not with the file's own end") {
  SlicedBench bench(40);
  std::vector<std::string> words = bench.print();
  words.emplace_back("--json");
  Child host(words);
  Bench::wait_for([&] { return is_in_the_middle(host.out()); }, host);
  kill(host.id(), SIGINT);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  const Seen seen = bench.seen();
  CHECK(seen.report["temperatures"]["nozzle"]["target"] == 0);
  CHECK(seen.report["temperatures"]["bed"]["target"] == 0);
  const auto parked = std::find_if(seen.lines.rbegin(), seen.lines.rend(), [](const std::string& line) {
    return line.find("Y100") != std::string::npos;
  });
  CHECK(parked != seen.lines.rend());
  CHECK(parked - seen.lines.rbegin() < 10);
}

TEST_CASE("A cable that is pulled while a slicer's G-code is printed costs nothing", "[optimised]") {
  const Seen whole = undisturbed();
  SlicedBench bench(100, {"--fault", "disconnect:100@line=250"});
  const Outcome outcome = test::run(bench.print());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.err, Contains("the printer is back"));
  test::check_equal(bench.seen(), whole);
}

TEST_CASE("A full disk makes the print of a slicer's G-code wait until there is room") {
  const Seen whole = undisturbed();
  SlicedBench bench(100);
  Child host(bench.print());
  Bench::wait_for([&] { return bench.begun(); }, host);
  // To the program, a limit on the size of files looks like a full disk.
  const rlimit full{10000, RLIM_INFINITY};
  const rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &full, nullptr) == 0);
  Bench::wait_for([&] { return host.err().find("make room") != std::string::npos; }, host);
  INFO(host.err());
  REQUIRE(host.running());
  REQUIRE(prlimit(host.id(), RLIMIT_FSIZE, &room, nullptr) == 0);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  test::check_equal(bench.seen(), whole);  // there was room again before the nozzle had nothing to do
}

TEST_CASE("A slicer's G-code that waits for a person is answered from the terminal, and goes on",
          "[optimised]") {
  const std::string text = block(4);
  const std::size_t middle = text.rfind(";LAYER_CHANGE");
  REQUIRE(middle != std::string::npos);
  SlicedBench bench(100, {"--personality", "marlin-host"});
  bench.folder().write("block.gcode", text.substr(0, middle) + "M0 Put the nut in\n" + text.substr(middle));
  const Outcome refused = test::run(bench.print());
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("--allow-stops"));
  test::Terminal terminal(bench.print({"--allow-stops"}));
  terminal.await("the printer asks \"M0 Stop\": answer 0 (Continue)");
  terminal.type("answer 0\n");
  CHECK(terminal.wait() == 0);
  const Seen seen = bench.seen();
  const auto stop = std::find_if(seen.lines.begin(), seen.lines.end(),
                                 [](const std::string& line) { return line.starts_with("M0"); });
  REQUIRE(stop != seen.lines.end());
  CHECK(std::count_if(stop, seen.lines.end(),
                      [](const std::string& line) { return line.starts_with("G1 "); }) > 40);
}

TEST_CASE("The speed that a person sets outlives the one that a slicer's G-code sets", "[optimised]") {
  std::string text = block();
  for (std::size_t at = text.find(";LAYER_CHANGE"); at != std::string::npos;
       at = text.find(";LAYER_CHANGE", at + 30))
    text.insert(at, "M220 S100\nM221 S95\n");
  SlicedBench bench(150);
  bench.folder().write("block.gcode", text);
  test::Terminal terminal(bench.print());
  terminal.await("printing layer");
  terminal.type("speed 150\n");
  terminal.await("speed is 150 % now");
  CHECK(terminal.wait() == 0);
  const Seen seen = bench.seen(), whole = undisturbed();
  const auto set = std::find(seen.lines.begin(), seen.lines.end(), "M220 S150");
  REQUIRE(set != seen.lines.end());
  const auto parked = std::find(set, seen.lines.end(), "M104 S0");
  CHECK(std::find(set, parked, "M220 S100") == parked);
  const auto laid = [](const Seen& print) { return print.report["extruded_mm"].get<double>(); };
  CHECK(laid(seen) == Approx(0.95 * laid(whole)).epsilon(0.01));
}

TEST_CASE("A G-code file is kept as stretches, of which the layers are those of the file") {
  SlicedBench bench(0);
  REQUIRE(test::run(bench.print()).code == 0);
  host::SpoolExtent extent;
  host::ChunkReader reader(bench.print_folder() / "chunks");
  while (const auto chunk = reader.next()) extent.add(*chunk);
  CHECK(extent.layers == layers);
  CHECK(extent.finished);
  CHECK(extent.chunks >= layers + 2);  // the start, the layers, the end
}
