#include "firmware_gcode/sliced/reader.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "firmware_gcode/sliced/survey.hpp"

namespace unicursal::gcode {
namespace {

const std::string warm = "G28\nM109 S210\n";
const std::string layer = ";LAYER_CHANGE\n;TYPE:External perimeter\n";

struct Read {
  std::vector<SlicedMove> moves;
  std::vector<std::string> passed;
  std::vector<int> tools;
  std::vector<std::string> notes;
  std::size_t layers = 0;
  std::map<int, Mixture> mixtures;
};

Read read(const std::string& text, SlicedLimits limits = {}, const Printer& printer = {}) {
  std::istringstream stream(text);
  SlicedReader reader(stream, "part.gcode", printer, limits);
  Read result;
  while (const auto step = reader.next()) {
    if (const auto* move = std::get_if<SlicedMove>(&*step)) result.moves.push_back(*move);
    if (const auto* pass = std::get_if<SlicedPass>(&*step)) result.passed.push_back(pass->text);
    if (const auto* tool = std::get_if<SlicedToolChange>(&*step)) result.tools.push_back(tool->tool);
    if (std::get_if<SlicedLayer>(&*step)) ++result.layers;
  }
  result.notes = reader.notes();
  result.mixtures = reader.own_mixtures();
  return result;
}

std::string refusal(const std::string& text, SlicedLimits limits = {}) {
  try {
    read(text, limits);
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Moves come out in absolute millimetres and relative filament, whatever the modes", "[sliced]") {
  const auto last = [](const std::string& text) { return read(warm + text).moves.back(); };
  const std::string lines = GENERATE(
      "G90\nM83\nG1 X10 Y20 Z1\nG1 X12 Y21 E0.5 F1200",
      "G90\nM82\nG92 E7\nG1 X10 Y20 Z1\nG1 X12 Y21 E7.5 F1200", "g1 x10 y20 z1\nm83\ng1x12y21e0.5f1200",
      "M83\nG1 X10 Y20 Z1\nG91\nG1 X2 Y1 E.5 F1200", "M83\nN1 G1 X10 Y20 Z1*99\nN2 G1 X12 Y21 E0.5 F1200 *12",
      "G20\nM83\nG1 X.393700787 Y.787401575 Z.039370079\nG1 X.472440945 Y.826771654 E.019685039 F47.244094",
      "M83\nG1 X10 Y20 Z1 F1200 ; go\nG1 X12 (right) Y21 E0.5",
      "M83\nG1 X10 Y20 Z1\nG92 X110\nG1 X112 Y21 E0.5 F1200\nG92 X12\nG1 X10 F1200\nG1 X12 E.5");
  CAPTURE(lines);
  const SlicedMove move = last(lines);
  CHECK(*move.to[0] == Approx(12));
  CHECK(*move.to[1] == Approx(21));
  CHECK(*move.to[2] == Approx(1));
  CHECK(move.filament == Approx(0.5));
  CHECK(move.feed == Approx(1200));
}

TEST_CASE("A relative move from an unknown place stays relative, and the next absolute one is whole",
          "[sliced]") {
  const Read file = read("G91\nG1 Z5 F600\nG90\nG28\nG1 X10 Y10\nG1 Z5\n");
  CHECK(file.passed == std::vector<std::string>{"G91", "G1 Z5 F600", "G90", "M83", "G28"});
  REQUIRE(file.moves.size() == 2);
  CHECK(!file.moves[0].to[2]);
  CHECK(*file.moves[1].to[2] == 5);
}

TEST_CASE("Homing forgets the axes that it moves", "[sliced]") {
  const Read file = read("G1 X10 Y10 Z10\nG28 X\nG1 Y20\n");
  CHECK(!file.moves.back().from[0]);
  CHECK(*file.moves.back().from[2] == 10);
}

TEST_CASE("A nozzle that waits is not this printer's", "[sliced]") {
  const Read file = read(
      "T0\nM104 S210\nM104 T1 S150\nM109 T0 S210\nT1\nM109 T1 S215\nM104 T0 S150\nM104 T0 S0\nM104 T1 S0\n");
  CHECK(file.passed == std::vector<std::string>{"M104 S210", "M109 S210", "M109 S215", "M104 S0"});
  CHECK(file.tools == std::vector<int>{0, 1});
}

TEST_CASE("A temperature that a file repeats is not sent again, since a person may have set another",
          "[sliced]") {
  const Read file =
      read(warm + "M140 S60\n" + layer + "M104 S210\nM140 S60\nM104 S205\nT1\nM104 S205\nM104 S210\n");
  CHECK(file.passed == std::vector<std::string>{"G28", "M109 S210", "M140 S60", "M104 S205", "M104 S210"});
}

TEST_CASE("Waiting for heat over the part is left out", "[sliced]") {
  const Read file = read(warm + layer + "M109 S215\nM190 R60\n");
  CHECK(file.passed == std::vector<std::string>{"G28", "M109 S210", "M104 S215", "M140 S60"});
}

TEST_CASE("The firmware's own retraction becomes the profile's", "[sliced]") {
  const Read file = read(warm + "M83\nG1 X1 Y1 Z1\nG10\nG10\nG11\nG10 P0 S200 R180\n");
  REQUIRE(file.moves.size() == 3);
  CHECK(file.moves[1].filament == -Printer().retraction_length);
  CHECK(file.moves[2].filament == Printer().retraction_length);
  CHECK(file.passed.back() == "M104 S200");
}

TEST_CASE("What would break a print is refused with its line", "[sliced]") {
  struct Case {
    const char *text, *says;
  };
  const Case one = GENERATE(
      Case{"M0", "M0 waits for a person"}, Case{"M600", "waits for a person"}, Case{"M112", "emergency stop"},
      Case{"M997", "firmware"}, Case{"M500", "keeps when it is switched off"}, Case{"M502", "settings back"},
      Case{"M302 S0", "cold extrusion"}, Case{"M302 P1", "cold extrusion"},
      Case{"G5 X1 Y1 I0 J3 E1", "spline"}, Case{"G54", "coordinates"},
      Case{"START_PRINT T=210\nM83\nM109 S210\nG1 X1 E1",
           "before the file has homed the axes; \"START_PRINT\" in line 1 is a macro"},
      Case{"PRINT_START\nM83\nG1 X1 E1",
           "before the file has heated the nozzle; \"PRINT_START\" in line 1 is a macro"},
      Case{"M28 x.gco", "own card"}, Case{"G1 X201", "x = 201 mm, outside the bed"},
      Case{"G1 Y-3", "outside the bed"}, Case{"G1 Z-2", "outside the bed"}, Case{"M104 S500", "500 °C"},
      Case{"M140 S250", "250 °C"}, Case{"G1 X1 E1", "before the file has heated"},
      Case{"M104 S100\nG1 X1 E1", "100 °C"}, Case{"M200 D1.75", "makes E a volume"},
      Case{"G28\nM109 S200\nG1 X1 E5000", "5000 mm of filament"}, Case{"G2 X10", "arc"},
      Case{"G1 X1\nG1 Y1\nG2 X10 Y10 I3 J0", "arc"}, Case{"G1 X--1", "cannot be read"},
      Case{"G1 Xnan", "cannot be read"}, Case{"G1 X1 X2", "cannot be read"}, Case{"M163 S4 P1", "feeder"},
      Case{"M164 S0", "without shares"}, Case{"M165 A-1 B2", "without shares"},
      Case{"M166 A0 Z10", "change the mixture by itself"}, Case{"G18", "arcs out of the layer"},
      Case{"; use_volumetric_e = 1", "mm³"}, Case{"M98 P\"x.g\"", "macro"});
  CAPTURE(one.text);
  const std::string said = refusal(one.text);
  CHECK_THAT(said, Catch::Contains(one.says));
  CHECK_THAT(said, Catch::StartsWith("part.gcode: line "));
}

TEST_CASE("The file's own speed and flow are applied to its moves, and not sent", "[sliced]") {
  const Read file = read(warm + layer +
                         "M83\nG1 X1 Y1 Z1 F600\nM220 S120\nM221 S95 T0\nG1 X2 E1\nM220 B\nM220 S50\nG1 X3 "
                         "E1\nM220 R\nG1 X4 E1\nM221 S100\nM220\nG1 E-2\nG91\nG1 X1 E1\n");
  for (const std::string& line : file.passed) CHECK(!line.starts_with("M22"));
  REQUIRE(file.moves.size() == 6);
  const auto check = [&](std::size_t index, double feed, double filament) {
    CAPTURE(index);
    CHECK(file.moves[index].feed == Approx(feed));
    CHECK(file.moves[index].filament == Approx(filament));
  };
  check(0, 600, 0);
  check(1, 720, 0.95);
  check(2, 300, 0.95);
  check(3, 720, 0.95);
  check(4, 720, -2);
  check(5, 720, 1);
  CHECK_THAT(refusal("M220 S0"), Catch::Contains("M220 S0 sets a rate that is not 1 to 999 %"));
  CHECK_THAT(refusal("M221 S-5"), Catch::Contains("not 1 to 999 %"));
}

TEST_CASE("A purge line beside the bed is refused unless the profile says that the nozzle can go there",
          "[sliced]") {
  const std::string purge = warm + "M83\nG1 X-1 Y-3 Z0.3\nG1 X60 E9\n";
  CHECK_THAT(refusal(purge), Catch::Contains("x = -1 mm, outside the bed of the profile (0 to 200 mm)") &&
                                 Catch::Contains("`overtravel`"));
  Printer printer;
  printer.overtravel = {2, 4};
  CHECK(read(purge, {}, printer).moves.size() == 2);
  printer.overtravel = {2, 2};
  CHECK_THROWS_WITH(read(purge, {}, printer),
                    Catch::Contains("y = -3 mm") && Catch::Contains("(-2 to 200 mm)"));
}

TEST_CASE("A person who stays may allow stops, and a pause that ends by itself needs none", "[sliced]") {
  SlicedLimits limits;
  limits.allow_stops = true;
  CHECK(read("M600\n", limits).passed == std::vector<std::string>{"M600"});
  CHECK(read("M0 S10\n").passed == std::vector<std::string>{"M0 S10"});
  CHECK(read("M25\n", limits).notes.size() == 1);
}

TEST_CASE("Unknown commands pass and are mentioned once, and words of other hosts are left out", "[sliced]") {
  const Read file =
      read("m1234 S1\nM1234 S2\nSTART_PRINT BED=60\nM117 Hello there\nT?\nT255\nM107\nM73 P3\n");
  CHECK(file.passed ==
        std::vector<std::string>{"M1234 S1", "M1234 S2", "M117 Hello there", "M107", "M73 P3"});
  REQUIRE(file.notes.size() == 4);
  CHECK_THAT(file.notes[0],
             Catch::Contains("1234 is not known to this program; it is sent as it is (and 1 more)"));
  CHECK(file.tools.empty());
}

TEST_CASE("A file that mixes already says what its tools are", "[sliced]") {
  const Read file = read(
      "M163 S0 P0.5\nM163 S1 P0.5\nM164 S1\nT1\nM163 S2 P1\nM164 S2\nT2\nM165 A1 B1\nM567 P0 "
      "E0.2:0.3:0.5\nT0\n");
  REQUIRE(file.tools.size() == 4);
  CHECK(file.mixtures.at(file.tools[0]) == Mixture({1, 1, 0}));
  CHECK(file.mixtures.at(file.tools[1]) == Mixture({0, 0, 1}));
  CHECK(file.tools[2] == file.tools[0]);  // equal mixtures are one
  CHECK(file.mixtures.at(file.tools[3]) == Mixture({0.2, 0.3, 0.5}));
}

TEST_CASE("A pause for filament of another colour becomes a change of mixture", "[sliced]") {
  std::istringstream stream(
      "T0\n;COLOR_CHANGE,T0,#FF8800\nM600\n;COLOR_CHANGE,T0,#0000ff\nM600\n;COLOR_CHANGE,T0,#ff8800\nM600\n");
  SlicedReader reader(stream, "part.gcode", Printer(), {});
  std::vector<int> tools;
  while (const auto step = reader.next()) {
    if (const auto* tool = std::get_if<SlicedToolChange>(&*step)) tools.push_back(tool->tool);
    CHECK(!std::holds_alternative<SlicedPass>(*step));
  }
  REQUIRE(tools.size() == 4);
  CHECK(reader.own_colours().at(tools[1]) == "#ff8800");
  CHECK(reader.own_colours().at(tools[2]) == "#0000ff");
  CHECK(tools[3] == tools[1]);
  CHECK_THAT(refusal(";COLOR_CHANGE,T0,#ff8800\nM600\nM600\n"), Catch::Contains("line 3"));
}

TEST_CASE("Without comments, layers are found by their height", "[sliced]") {
  std::string text = warm + "M83\n";
  for (int i = 1; i <= 5; ++i)
    text += "G1 Z" + std::to_string(0.2 * i) + "\nG1 X10 Y10\nG1 X20 E1\nG1 Z" + std::to_string(0.2 * i + 1) +
            "\nG1 X0\n";
  CHECK(read(text).layers == 5);
}

TEST_CASE("The names of features and layers of each slicer are understood", "[sliced]") {
  struct Case {
    const char* comment;
    Feature feature;
  };
  const Case one = GENERATE(
      Case{"TYPE:External perimeter", Feature::outer_wall},
      Case{"TYPE:Overhang perimeter", Feature::outer_wall}, Case{"TYPE:Perimeter", Feature::inner_wall},
      Case{"TYPE:Internal infill", Feature::sparse}, Case{"TYPE:Solid infill", Feature::solid},
      Case{"TYPE:Top solid infill", Feature::top}, Case{"TYPE:Bridge infill", Feature::bottom},
      Case{"TYPE:Internal bridge infill", Feature::solid},
      Case{"TYPE:Support material interface", Feature::support}, Case{"TYPE:Skirt/Brim", Feature::aside},
      Case{"TYPE:Wipe tower", Feature::tower}, Case{"TYPE:Custom", Feature::custom},
      Case{"TYPE:Ironing", Feature::top}, Case{" FEATURE: Outer wall", Feature::outer_wall},
      Case{" FEATURE: Sparse infill", Feature::sparse}, Case{" FEATURE: Bottom surface", Feature::bottom},
      Case{" FEATURE: Prime tower", Feature::tower}, Case{"TYPE:WALL-INNER", Feature::inner_wall},
      Case{"TYPE:FILL", Feature::sparse}, Case{"TYPE:SKIN", Feature::top},
      Case{"TYPE:PRIME-TOWER", Feature::tower}, Case{"TYPE:SUPPORT-INTERFACE", Feature::support},
      Case{"TYPE:SOLID-FILL", Feature::top}, Case{" FEATURE: Floating vertical shell", Feature::inner_wall},
      Case{"TYPE:Gizmo", Feature::unknown}, Case{" 'Loop Path', 1.0 [feed mm/s]", Feature::inner_wall},
      Case{" 'Stacked Sparse Infill Path', 1.0 [feed mm/s]", Feature::sparse},
      Case{" 'Prime Pillar Path', 1.0 [feed mm/s]", Feature::tower});
  CAPTURE(one.comment);
  CommentState state;
  read_comment(one.comment, state);
  CHECK(state.present() == one.feature);
  CHECK(state.any_feature);
}

TEST_CASE("A purge line before the first mark of a layer is not a layer", "[sliced]") {
  const std::string text =
      warm +
      "M83\nG1 X1 Y1 Z0.3\nG1 Y100 E10\nG1 X5 Y5\n;LAYER:0\n;TYPE:WALL-OUTER\nG1 X50 Y50 Z0.2\nG1 X60 E1\n"
      ";LAYER:1\nG1 Z0.4\nG1 X50 E1\n";
  std::istringstream stream(text);
  const SlicedSurvey seen = survey_sliced(stream, "part.gcode", Printer(), {});
  CHECK(seen.layers == 2);
  CHECK(seen.marked);
  CHECK(seen.extent.min.y() == 50);
  CHECK(seen.layer_height == Approx(0.2));
  CHECK(seen.first_layer_height == Approx(0.2));
}

TEST_CASE("Simplify3D marks a layer once for each process, and its settings are not features", "[sliced]") {
  const std::string head =
      "; G-Code generated by Simplify3D(R) Version 4.1.2\n;   mergeAllIntoSolid,0\n" + warm + "M83\n";
  std::string text = head;
  for (int process = 0; process < 2; ++process)
    text +=
        "; layer 1, Z = 0.200\n; tool H0.200 W0.480\n; feature outer perimeter\nG1 X1 Y1 Z0.2\nG1 X9 E1\n";
  text += "; layer 2, Z = 0.400\n; internal single extrusion\nG1 X1 Y1 Z0.4\nG1 X9 E1\n";
  const Read file = read(text);
  CHECK(file.layers == 2);
  CHECK(file.moves[1].width == 0.48);
  CHECK(file.moves[1].feature == Feature::outer_wall);
  CHECK(file.moves.back().feature == Feature::inner_wall);
}

TEST_CASE("A file that does not wait for heat is made to, before it extrudes", "[sliced]") {
  CHECK(read("G28\nM104 S210\nM83\nG1 X1 Y1 Z1\nG1 X9 E1\n").passed ==
        std::vector<std::string>{"G28", "M104 S210", "M109 S210"});
  CHECK(read("M140 S60\nM104 S215 T0\nM116\n").passed ==
        std::vector<std::string>{"M140 S60", "M104 S215", "M190 S60", "M109 S215"});
  CHECK(read("G10 P0 S215 R180\nG10 P0 R180\nM568 P0 S205 R100\n").passed ==
        std::vector<std::string>{"M104 S215", "M104 S205"});
}

TEST_CASE("FlashPrint changes tools by M108 and homes by G161", "[sliced]") {
  const Read file = read(
      ";generated by ffslicer 1.30\nM108 T1\nG161 X Y F3300\nM109 S210\n;layer:0.30\n;shell\nM83\nG28\nG1 X1 "
      "Y1 Z1\nG1 X9 E1\n");
  CHECK(file.tools == std::vector<int>{1});
  CHECK(file.passed.front() == "G28 X Y");
  CHECK(file.moves.back().feature == Feature::outer_wall);
  CHECK(file.layers == 1);
}

TEST_CASE("The flushing of Bambu's changer is not printed", "[sliced]") {
  const Read file = read(warm + "M83\nG1 X1 Y1 Z1\n; FLUSH_START\nG1 E20\n; FLUSH_END\nG1 X9 E1\n");
  CHECK(file.moves[1].ramming);
  CHECK(!file.moves[2].ramming);
}

TEST_CASE("Colours and diameters come from the slicer's settings", "[sliced]") {
  CommentState state;
  read_comment(" filament_colour = #00FF00;#0000ff", state);
  read_comment(" extruder_colour = ;#FF0000;", state);
  read_comment(" filament_diameter = 2.85,2.85", state);
  CHECK(state.colour(0) == "#00ff00");
  CHECK(state.colour(1) == "#ff0000");
  CHECK(state.colour(2).empty());
  CHECK(state.colour(-1).empty());
  CHECK(state.filament_diameter == 2.85);
  read_comment(" filament_colour = red;#12345", state);
  CHECK(state.colour(1) == "#ff0000");
  read_comment(" default_filament_colour = ", state);  // OrcaSlicer
  read_comment(" filament_colour = #161616", state);
  CHECK(state.colour(0) == "#161616");
}

TEST_CASE("Lines end in every way, and what is not text is refused", "[sliced]") {
  const auto lines = [](const std::string& text) {
    std::istringstream stream(text);
    LineSource source(stream, "x.gcode");
    std::vector<std::string> all;
    while (const auto line = source.next()) all.emplace_back(*line);
    return all;
  };
  CHECK(lines("a\r\nb\nc") == std::vector<std::string>{"a", "b", "c"});
  CHECK(lines("\xef\xbb\xbf"
              "a\n\nb\n") == std::vector<std::string>{"a", "", "b"});
  CHECK(lines("").empty());
  const std::string long_comment(10'000'000, 'x');
  const auto cut = lines("G1 X1 ;" + long_comment + "\nG1 X2\n");
  REQUIRE(cut.size() == 2);
  CHECK(cut[0].size() < 100'000);
  CHECK(cut[1] == "G1 X2");
  CHECK_THROWS_WITH(lines(std::string(10'000'000, 'G')),
                    Catch::Contains("line 1") && Catch::Contains("4096"));
  CHECK_THROWS_WITH(lines(std::string("GCDE\x01\x00", 6)), Catch::Contains("binary G-code"));
  CHECK_THROWS_WITH(lines(std::string("G1 X1\nG\x00", 8)), Catch::Contains("line 2"));
  CHECK_THROWS_WITH(lines(std::string("PK\x03\x04zip", 7)), Catch::Contains("zip archive"));
}

}  // namespace unicursal::gcode
