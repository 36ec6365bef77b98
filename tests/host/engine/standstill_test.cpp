// Words that are lost on the line, on a firmware that does not report that it is busy: how long the hot
// nozzle stands on the part.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::test::replaced;
using unicursal::test::SampleFiles;
using unicursal::test::SessionBench;

namespace {

struct Course {
  Ending ending = Ending::failed;
  double seconds = 0, longest_stop = 0;
  std::size_t probes = 0, faults = 0;
};

Course print_with(const std::string& firmware, const std::vector<std::string>& faults) {
  SampleFiles sample;
  sample.job = replaced(unicursal::test::sample_job, "height = 0.4", "height = 1.6");
  std::vector<std::string> options{"--personality", firmware};
  for (const std::string& fault : faults) options.insert(options.end(), {"--fault", fault});
  SessionBench bench(options, "", sample);
  bench.settings.link.temperatures = std::chrono::seconds(2);
  const StreamResult result = bench.print();
  const nlohmann::json seen = bench.seen();
  Course course{result.ending, seen["printer_seconds"], 0, result.statistics.probes, 0};
  for (const auto& stop : seen["motion"]["stops"])
    course.longest_stop = std::max(course.longest_stop, stop["seconds"].get<double>());
  for (const auto& [name, times] : seen["faults"].items()) course.faults += times.get<std::size_t>();
  CHECK(seen["executed_lines_in_order"] == true);
  return course;
}

}  // namespace

TEST_CASE("Lost words hold the nozzle for less than a second, and the print for less than a tenth",
          "[optimised]") {
  const std::string firmware = GENERATE("marlin", "marlin-advanced-ok", "marlin-8bit");
  CAPTURE(firmware);
  const Course plain = print_with(firmware, {});
  const Course lossy = print_with(firmware, {"lostok:0.01", "lostresend:0.01", "merge:0.003"});
  CAPTURE(plain.seconds, plain.probes, lossy.seconds, lossy.probes, lossy.faults, lossy.longest_stop);
  CHECK(lossy.ending == Ending::completed);
  CHECK(lossy.faults > 10);
  CHECK(lossy.longest_stop <= 1);
  CHECK(lossy.seconds <= 1.1 * plain.seconds);
  CHECK(plain.probes <= 2);
}
