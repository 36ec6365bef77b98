// The table of what firmwares say (firmware_gcode/reply/phrases.hpp), held against what the simulated
// printers say, which were written from the firmwares and not from the table.
#include "firmware_gcode/reply/phrases.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "virtual_printer.hpp"

using namespace unicursal;
using gcode::Meaning;

TEST_CASE("what simulated printers say when they do not do what they were told is in the table of phrases") {
  using Lines = std::vector<std::string>;
  const auto [who, fault, lines, meaning] = GENERATE(table<std::string, std::string, Lines, Meaning>({
      {"marlin", "", {"G1 X10 E5 F1200"}, Meaning::too_cold},
      {"marlin", "", {"M302 S0", "G1 X10 E250 F1200"}, Meaning::too_long},
      {"marlin-few-tools", "", {"G28", "T5"}, Meaning::no_such_tool},
      {"marlin-host", "", {"G1 X10 F1200"}, Meaning::refuses_to_move},
      {"marlin", "stopped@line=1", {"G1 X10 F1200"}, Meaning::stopped},
      {"marlin", "heaterfail@line=1", {"M109 S210"}, Meaning::stopped},
      {"marlin", "thermistor@line=1", {"G4 S5"}, Meaning::stopped},
      {"marlin", "", {"M112"}, Meaning::stopped},
      {"repetier", "stopped@line=1", {"G1 X10 F1200"}, Meaning::stopped},
      {"repetier", "heaterfail@line=1", {"M109 S210", "G4 S100"}, Meaning::stopped},
      {"repetier", "thermistor@line=1", {"G4 S5"}, Meaning::stopped},
  }));
  CAPTURE(who, fault, lines);
  std::vector<std::string> options{"--personality", who};
  if (!fault.empty()) options.insert(options.end(), {"--fault", fault});
  test::VirtualPrinter printer(options);
  Lines all = lines;
  all.insert(all.end(), 30, "G4 S5");  // time to notice what is wrong
  const test::Talk talk = printer.print(all);
  CAPTURE(talk.messages);
  const Meaning wanted = meaning;
  CHECK(std::any_of(talk.messages.begin(), talk.messages.end(),
                    [&](const std::string& line) { return gcode::meaning_of(line) == wanted; }));
  // A printer that only leaves something out goes on; the session decides what becomes of the print.
  CHECK(talk.error.empty() == (meaning == Meaning::too_cold || meaning == Meaning::too_long));
}
