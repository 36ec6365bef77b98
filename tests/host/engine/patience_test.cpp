// What takes long, or is said oddly, does not end a print, and costs no more time than it has to.
#include <catch2/catch.hpp>

#include "tests/host/support/session_bench.hpp"

using namespace unicursal::host;
using unicursal::test::SessionBench;

namespace {

struct Took {
  Ending ending;
  double seconds;  ///< of the printer
  bool in_order;
};

Took print(const std::vector<std::string>& faults, const std::string& start = "") {
  std::vector<std::string> options;
  for (const std::string& fault : faults) options.insert(options.end(), {"--fault", fault});
  SessionBench bench(options, start.empty() ? "" : "\n[gcode]\nstart = \"" + start + "\"\n");
  bench.settings.link.temperatures = std::chrono::seconds(1);
  const StreamResult result = bench.print();
  const nlohmann::json seen = bench.seen();
  return {result.ending, seen["printer_seconds"], seen["executed_lines_in_order"]};
}

}  // namespace

TEST_CASE("A command that works for long, silently or with chatter, is waited for and costs nothing more") {
  const std::string kind = GENERATE("silentwork", "chattywork");
  const std::string command = GENERATE("G29", "G28");
  CAPTURE(kind, command);
  const Took quick = print({kind + ":0@command=" + command}, "G28\\nG29");
  const Took slow = print({kind + ":300@command=" + command}, "G28\\nG29");
  CHECK(slow.ending == Ending::completed);
  CHECK(slow.in_order);
  const double times = command == "G28" ? 2 : 1;  // the program homes as well, while it heats
  CHECK(slow.seconds > quick.seconds + 290);
  CHECK(slow.seconds < quick.seconds + 300 * times + 15);
}

TEST_CASE("A board that boots for 20 s is waited for") {
  const Took quick = print({}), slow = print({"slowboot:20"});
  CHECK(slow.ending == Ending::completed);
  CHECK(slow.seconds == Approx(quick.seconds + 20).margin(6));
}

TEST_CASE("An ok that is glued to a report of temperatures counts, so that nothing stands still") {
  const Took quick = print({}), glued = print({"gluedok:1"});
  CHECK(glued.ending == Ending::completed);
  CHECK(glued.in_order);
  CHECK(glued.seconds < quick.seconds + 2);
}
