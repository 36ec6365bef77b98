// A daemon prints a slicer's G-code as it prints a job.
#include <catch2/catch.hpp>

#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;

TEST_CASE("A daemon queues and prints a slicer's G-code, and refuses one that would break the print") {
  test::DaemonBench bench;
  gcode::test::BlockOptions options;
  options.layers = 3;
  const std::string text = gcode::test::sliced_block(options).text;
  bench.folder().write("jobs/block.gcode", text);
  bench.folder().write("jobs/bad.gcode", test::replaced(text, "G92 E0\n", "G92 E0\nM112\n"));
  bench.start_printer("0");
  bench.serve({"--profile", bench.path("jobs/bench.toml.profile")});
  CHECK_THAT(bench.ask("GET", "/api/files").dump(), Contains("block.gcode"));
  const nlohmann::json refused = bench.ask("POST", "/api/jobs", R"({"job": "bad.gcode"})");
  CHECK_THAT(refused.dump(), Contains("M112"));
  const nlohmann::json queued = bench.ask("POST", "/api/jobs", R"({"job": "block.gcode"})");
  CAPTURE(queued.dump());
  const int id = queued.at("id");
  bench.ask("POST", "/api/print/start", "{}");
  bench.await_job(id, "done");
  CHECK_THAT(bench.transcript(), Contains("M163") && Contains("G1 "));
}
