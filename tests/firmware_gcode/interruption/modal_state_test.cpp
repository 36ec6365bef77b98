#include "firmware_gcode/interruption/modal_state.hpp"

#include <catch2/catch.hpp>

#include "firmware_gcode/interruption/lead_in.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

ModalState after(const std::vector<std::string>& lines) {
  ModalState state;
  for (const std::string& line : lines) state.run(line);
  return state;
}

const std::vector<std::string> a_print{"M140 S60",
                                       "M104 S210",
                                       "G28",
                                       "M190 S60",
                                       "M109 S210",
                                       "G21",
                                       "G90",
                                       "M83",
                                       "G92 E0",
                                       "M163 S0 P1",
                                       "M163 S1 P0",
                                       "M163 S2 P0",
                                       "M164 S0",
                                       "M163 S0 P.333",
                                       "M163 S1 P.333",
                                       "M163 S2 P.333",
                                       "M164 S1",
                                       "T0",
                                       "G1 Z.2 F600",
                                       "G0 X10 Y20 F9000",
                                       "T1",
                                       "G1 E4 F1500",
                                       "T0",
                                       "G1 X30 E.5 F1200",
                                       "G1 Y21.5 E.03",
                                       "M106 S128"};

}  // namespace

TEST_CASE("the modal state after a print's lines is complete") {
  const ModalState state = after(a_print);
  CHECK(state.position[0] == 30);
  CHECK(state.position[1] == 21.5);
  CHECK(state.position[2] == 0.2);
  CHECK(state.feed == 1200);
  CHECK(state.tool == 0);
  CHECK(state.nozzle == 210);
  CHECK(state.bed == 60);
  CHECK(state.fan == 128);
  CHECK(state.drawn_back == 0);
  CHECK_FALSE(state.relative);
  CHECK(state.relative_filament);
  CHECK(state.tools.at(0) == ModalState::Lines{"M163 S0 P1", "M163 S1 P0", "M163 S2 P0", "M164 S0"});
  CHECK(state.tools.at(1).back() == "M164 S1");
}

TEST_CASE("a retraction is known until it is undone") {
  ModalState state = after(a_print);
  state.run("G1 E-4 F1500");
  CHECK(state.drawn_back == 4);
  state.run("G0 X50");
  CHECK(state.drawn_back == 4);
  state.run("G1 E3");
  CHECK(state.drawn_back == 1);
  state.run("G1 E5");
  CHECK(state.drawn_back == 0);
}

TEST_CASE("relative moves, G92 and homing") {
  ModalState state = after(a_print);
  state.run("G91");
  state.run("G1 Z10 F600");
  CHECK(*state.position[2] == Approx(10.2));
  state.run("G90");
  CHECK_FALSE(state.relative_filament);  // Marlin: G90 overrides M83
  state.run("G92 Z10.6");
  CHECK(state.position[2] == 10.6);
  state.run("G28 X Y");
  CHECK_FALSE(state.position[0]);
  CHECK(state.position[2] == 10.6);
  state.run("G28");
  CHECK_FALSE(state.position[2]);
}

TEST_CASE("unknown lines do not change the modal state") {
  for (const char* line : {"", "G", "M", "T", "X1", "G1 X", "G1 Xabc", "M163", "M164 S", "G99999999999",
                           "M117 X3 S4", "G1  X 5", "\xff\xfe"}) {
    ModalState state = after(a_print);
    state.run(line);
    INFO(line);
    CHECK(state.position[0] == 30);
    CHECK(state.nozzle == 210);
  }
}

TEST_CASE("a lead-in ends in the wanted state, from any state") {
  Printer printer;
  for (const double drawn_back : {0.0, 4.0}) {
    ModalState wanted = after(a_print);
    wanted.drawn_back = drawn_back;
    const Chunk chunk = lead_in(printer, {wanted, 0.2, 2, core::Box{{90, 90}, {110, 110}}});
    CHECK(chunk.warnings.empty());
    ModalState state;
    state.position[2] = 0.2;        // height of the nozzle
    state.drawn_back = drawn_back;  // retraction of the filament
    for (const std::string& line : chunk.lines) state.run(line);
    CHECK(state.position == wanted.position);
    CHECK(state.feed == wanted.feed);
    CHECK(state.tool == wanted.tool);
    CHECK(state.tools == wanted.tools);
    CHECK(state.drawn_back == Approx(drawn_back));
    CHECK(state.nozzle == wanted.nozzle);
    CHECK(state.bed == wanted.bed);
    CHECK(state.fan == wanted.fan);
    CHECK(state.relative_filament);
    CHECK_FALSE(state.relative);
  }
}

TEST_CASE("a lead-in moves only when hot, rises first, and never homes z") {
  const Chunk chunk = lead_in(Printer{}, {after(a_print), 0.2, 2, core::Box{{90, 90}, {110, 110}}});
  bool hot = false, risen = false;
  for (const std::string& line : chunk.lines) {
    INFO(line);
    if (line == "M109 S210") hot = true;
    const bool moves = line.rfind("G0", 0) == 0 || line.rfind("G1", 0) == 0 || line.rfind("G28", 0) == 0;
    if (!moves) continue;
    CHECK(hot);
    if (!risen) CHECK(line == "G1 Z10.2 F600");
    risen = true;
    if (line.rfind("G28", 0) == 0) CHECK(line == "G28 X Y");
  }
  CHECK(risen);
}

TEST_CASE("a lead-in into the middle of a tool definition repeats the shares before it") {
  std::vector<std::string> lines = a_print;
  lines.insert(lines.end(), {"M163 S0 P.2", "M163 S1 P.3"});
  ModalState state;
  for (const std::string& line :
       lead_in(Printer{}, {after(lines), 0.2, 2, core::Box{{90, 90}, {110, 110}}}).lines)
    state.run(line);
  state.run("M163 S2 P.5");  // the next line of the print
  state.run("M164 S0");
  CHECK(state.tools.at(0) == ModalState::Lines{"M163 S0 P.2", "M163 S1 P.3", "M163 S2 P.5", "M164 S0"});
}

TEST_CASE("a lead-in undoes the whole retraction, and draws back in equal shares in every dialect") {
  struct Equal {
    std::vector<std::string> definition;
    PerFeeder flow_factors;
  };
  const std::vector<Equal> dialects = {
      {{"M163 S0 P.3334", "M163 S1 P.3333", "M163 S2 P.3333", "M164 S2"}, {1, 1, 1}},
      {{"M163 S0 P34", "M163 S1 P33", "M163 S2 P33", "M164 S2"}, {1, 1, 1}},              // Repetier
      {{"M163 S0 P.3279", "M163 S1 P.3442", "M163 S2 P.3279", "M164 S2"}, {1, 1.05, 1}},  // a slipping feeder
  };
  for (const Equal& equal : dialects) {
    std::vector<std::string> lines = a_print;
    lines.insert(lines.end(), equal.definition.begin(), equal.definition.end());
    LeadIn to{after(lines), 0.2, 2, core::Box{{90, 90}, {110, 110}}};
    to.state.tools.erase(1);
    Printer printer;
    printer.flow_factors = equal.flow_factors;
    const auto pushed = [&](double drawn) {
      to.drawn = drawn;
      double sum = 0;
      std::string tool;
      for (const std::string& line : lead_in(printer, to).lines) {
        if (line.starts_with("T")) tool = line;
        if (line.starts_with("G1 E")) sum += std::stod(line.substr(4));
        if (line.starts_with("G1 E-")) CHECK(tool == "T2");
      }
      return sum;
    };
    CHECK(pushed(8) - pushed(0) == Approx(8));
  }
}

TEST_CASE(
    "a RepRapFirmware gets its tool before the heat, its height before it rises, and its mixture at the "
    "end") {
  std::vector<std::string> lines = a_print;
  lines.insert(lines.end(), {"T0 P0", "M567 P0 E.2:.3:.5"});
  const LeadIn to{after(lines), 0.2, 2, core::Box{{90, 90}, {110, 110}}, 0};
  Printer printer;
  printer.firmware = "reprapfirmware";
  const std::vector<std::string> led = lead_in(printer, to).lines;
  const auto at = [&](const std::string& begin) {
    return std::find_if(led.begin(), led.end(), [&](const auto& line) { return line.starts_with(begin); }) -
           led.begin();
  };
  CHECK(led.front() == "T0 P0");
  CHECK(at("G92 Z.2") < at("G1 Z10.2"));
  CHECK(at("G1 Z10.2") < at("G28 X Y"));
  CHECK(at("M567 P0 E.3334:.3333:.3333") < std::ssize(led));  // filament is drawn in equal shares
  const auto last_mixture =
      std::find_if(led.rbegin(), led.rend(), [](const auto& l) { return l.starts_with("M567"); });
  REQUIRE(last_mixture != led.rend());
  CHECK(*last_mixture == "M567 P0 E.2:.3:.5");
}

TEST_CASE("a lead-in keeps below the printer's height, and warns if nothing can be squeezed out") {
  const Printer printer;
  const auto rises_to = [&](double height) {
    const Chunk chunk = lead_in(printer, {after(a_print), height, 2, core::Box{{0, 0}, {10, 10}}});
    return *std::find_if(chunk.lines.begin(), chunk.lines.end(),
                         [](const std::string& line) { return line.starts_with("G1 Z"); });
  };
  CHECK(rises_to(0.2).starts_with("G1 Z10.2 "));
  CHECK(rises_to(195).starts_with("G1 Z200 "));
  CHECK(rises_to(200).starts_with("G1 Z200 "));
  const Chunk chunk = lead_in(printer, {after(a_print), 0.2, 2, core::Box{{0, 0}, {200, 200}}});
  REQUIRE(chunk.warnings.size() == 1);
  CHECK(chunk.volume == 0);
}

TEST_CASE("a target may be given by R, and a line without a number changes none") {
  const ModalState state = after({"M140 S60", "M190 R55", "M104 S200", "M109 R210"});
  CHECK(state.bed == 55);
  CHECK(state.nozzle == 210);
  CHECK(after({"M104 S200", "M109"}).nozzle == 200);
  CHECK(after({"M104 S200", "M104 S0"}).nozzle == 0);
}
