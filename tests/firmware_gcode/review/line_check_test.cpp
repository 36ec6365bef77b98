#include "firmware_gcode/review/line_check.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

const std::vector<std::string> sound = {
    "M109 S210",   "G28",     "G90", "M83",         "G92 E0",           "M163 S0 P.5", "M163 S1 P.5",
    "M163 S2 P0",  "M164 S0", "T0",  "G1 Z.2 F600", "G0 X10 Y10 F9000", "G1 E4 F1500", "G1 X20 E.4 F1200",
    "G1 E-4 F1500"};

MoveListener deaf() {
  return {[](const PerAxis&, double) {}, [] {}};
}

/// The complaint about the sound lines followed by `more`.
std::string complaint(const std::vector<std::string>& more, const std::string& firmware = "marlin") {
  const Printer printer;
  LineCheck check(printer, dialect_named(firmware));
  Chunk chunk;
  chunk.lines = sound;
  check.read(chunk, "layer 6", deaf());
  chunk.lines = more;
  try {
    check.read(chunk, "layer 7", deaf());
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("sound lines pass and are reported as moves") {
  const Printer printer;
  LineCheck check(printer, dialect_named("marlin"));
  Chunk chunk;
  chunk.lines = sound;
  std::vector<PerAxis> moves;
  std::vector<double> speeds;
  int stops = 0;
  check.read(chunk, "layer 0",
             {[&](const PerAxis& d, double speed) { moves.push_back(d), speeds.push_back(speed); },
              [&] { ++stops; }});
  REQUIRE(moves.size() == 5);
  CHECK(moves[0] == PerAxis{0, 0, 0.2, 0});
  CHECK(moves[3] == PerAxis{10, 0, 0, 0.4});
  CHECK(moves[4] == PerAxis{0, 0, 0, -4});
  CHECK(speeds == std::vector<double>{10, 150, 25, 20, 25});
  CHECK(stops == 1);  // homing
  CHECK(complaint({}).empty());
}

TEST_CASE("every kind of harmful line is refused with its place and text") {
  const auto [lines, word] = GENERATE(table<std::vector<std::string>, std::string>({
      {{"G0 X200.1 F6000"}, "bed"},
      {{"G0 Y-.1 F6000"}, "bed"},
      {{"G1 Z201 F600"}, "bed"},
      {{"G0 X30 F9400"}, "faster"},
      {{"G1 Z5 F660"}, "faster"},
      {{"G1 E1 F3000"}, "too fast"},
      {{"G1 X30 E201 F10"}, "more than the firmware"},
      {{"G1 X30 E2.5 F4000"}, "melts"},  // 6 mm³ on 10 mm in 0.15 s
      {{"G1 X30 E-1 F1200"}, "drawn back on the way"},
      {{"G1 E-.1 F1500"}, "drawn back too far"},
      {{"G1 E4 F1500", "G1 E.1"}, "pushed further"},
      {{"G90", "G1 X30 E.4 F1200"}, "not relative"},
      {{"G28", "G1 X30 E.4 F1200"}, "unknown place"},
      {{"M104 S0", "G1 X30 E.4 F1200"}, "cold"},
      {{"M104 S600"}, "hot"},
      {{"M140 S250"}, "hot"},
      {{"T1"}, "never defined"},
      {{"T"}, "no number"},
      {{"M163 S0 P0", "M163 S1 P0", "M163 S2 P0", "M164 S1"}, "hang"},
      {{"M163 S0 P1", "M164 S1"}, "before all feeders"},
      {{"M163 S3 P1"}, "feeder"},
      {{"M163 S0 P-1"}, "negative"},
      {{"G1 X30 X31"}, "twice"},
      {{"G1 X3O"}, "number"},
      {{"G1 X"}, "empty"},
      {{"G1 Xnan"}, "number"},
      {{"G1 I3"}, "letter that moves do not have"},
      {{"G2 X1 Y1 I3"}, "such a command"},
      {{"M112"}, "such a command"},
      {{" G1 X30"}, "begins with a space"},
      {{"G0 X10 *33"}, "character"},
      {{"M117 " + std::string(90, 'x')}, "too long"},
  }));
  const std::string said = complaint(lines);
  INFO(lines.back());
  INFO(said);
  CHECK(said.find(word) != std::string::npos);
  CHECK(said.find("layer 7, line ") != std::string::npos);
  CHECK(said.find(lines.back().substr(0, 6)) != std::string::npos);
}

TEST_CASE("flow is checked over half a millimetre, not in every tiny move") {
  // 0.001 mm with the filament of 0.02 mm would be 20 times the flow
  CHECK(complaint({"G1 E4 F1500", "G1 X20.001 E.0008 F1200", "G1 X21 E.04"}).empty());
  std::vector<std::string> crumbs = {"G1 E4 F1500", "G1 X20.1 E.03 F6000"};
  for (const char* x : {"20.2", "20.3", "20.4", "20.5", "20.6"}) {
    crumbs.push_back("G1 X" + std::string(x) + " E.03");
  }
  CHECK(complaint(crumbs).find("melts") != std::string::npos);
}

TEST_CASE("the user's own lines are skipped, and no state is assumed behind them") {
  CHECK(complaint({user_lines_begin, "G29", "G1 X-5 F99999", user_lines_end}).empty());
  CHECK(complaint({user_lines_begin, "G91", user_lines_end, "M83", "T0", "G1 X30 E.4 F1200"})
            .find("unknown place") != std::string::npos);
}

TEST_CASE("a refusal does not change the state") {
  const Printer printer;
  LineCheck check(printer, dialect_named("marlin"));
  Chunk chunk;
  chunk.lines = sound;
  check.read(chunk, "layer 0", deaf());
  chunk.lines = {"G1 E4 F1500", "G0 X300"};
  CHECK_THROWS_AS(check.read(chunk, "layer 1", deaf()), core::DataError);
  chunk.lines = {"G1 E4 F1500"};  // the filament is still drawn back
  CHECK_NOTHROW(check.read(chunk, "layer 1", deaf()));
}

TEST_CASE("the time estimate stops at T if T waits for the end of motion") {
  const Printer printer;
  LineCheck check(printer, dialect_named("repetier"));
  Chunk chunk;
  chunk.lines = sound;
  int stops = 0;
  check.read(chunk, "layer 0", {[](const PerAxis&, double) {}, [&] { ++stops; }});
  CHECK(stops == 2);
  CHECK(complaint({"G1 X30 E161 F10"}, "repetier").find("more than the firmware") != std::string::npos);
}

TEST_CASE("RepRapFirmware's mixtures add up to one, and belong to the tool that is chosen") {
  Printer printer;
  printer.firmware = "reprapfirmware";
  const auto complaint = [&](const std::vector<std::string>& lines) -> std::string {
    LineCheck check(printer, dialect_named("reprapfirmware"));
    Chunk chunk;
    chunk.lines = lines;
    try {
      check.read(chunk, "layer 7", deaf());
    } catch (const core::DataError& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [&](const std::string& mixture) {
    return complaint({"T0 P0", "M109 S210", "G28", "G90", "M83", mixture, "G1 Z.2 F600", "G0 X10 Y10 F9000",
                      "G1 E4 F1500", "G1 X20 E.4 F1200"});
  };
  CHECK(with("M567 P0 E.5:.25:.25").empty());
  CHECK(with("M567 P0 E.5:.25:.24").find("do not add up") != std::string::npos);
  CHECK(with("M567 P0 E.5:.5").find("one share for each feeder") != std::string::npos);
  CHECK(with("M567 P0 E1.5:-.5:0").find("negative") != std::string::npos);
  CHECK(with("M567 P1 E.5:.25:.25").find("not the tool that mixes") != std::string::npos);
  CHECK(with("T1 P0").find("not the tool that mixes") != std::string::npos);
  CHECK(with("M400").find("no tool is chosen") != std::string::npos);
  CHECK(complaint({"M567 P0 E.5:.25:.25"}).find("not chosen") != std::string::npos);
}

TEST_CASE("Marlin does not know M567") {
  CHECK(complaint({"M567 P0 E.5:.25:.25"}).find("does not know") != std::string::npos);
}
