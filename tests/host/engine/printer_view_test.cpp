// What a session makes of the lines that come from the printer.
#include <catch2/catch.hpp>

#include "host/engine/printer_view.hpp"

using namespace unicursal::host;

TEST_CASE("A line from the printer is understood by its meaning for the print") {
  using Kind = Remark::Kind;
  const auto [line, kind] = GENERATE(table<std::string, Kind>({
      {"ok T:20.5 /0.0 B:21.0 /0.0 @:0", Kind::temperatures},
      {" T:24.1 /210.0 B:23.9 /60.0 @:127 W:?", Kind::temperatures},
      {"echo:Unknown command: \"M85 S1800\"", Kind::unknown_m85},
      {"echo:Unknown command: \"M163 S99 P1\"", Kind::no_mixing},
      {"echo:Unknown command: \"M999\"", Kind::unknown},
      {"echo:Some words for a person", Kind::other},
      {"echo: cold extrusion prevented", Kind::too_cold},
      {"//action:pause", Kind::action},
      {"Error:Printer halted. kill() called!", Kind::halted},
      {"Error:No Line Number with checksum, Last Line: 3", Kind::other},
      {"lithobraking", Kind::other},
  }));
  CAPTURE(line);
  PrinterView printer;
  CHECK(printer.hear(line).kind == kind);
  CHECK(printer.mixes == (kind != Kind::no_mixing));
  CHECK(printer.halted == (kind == Kind::halted));
}

TEST_CASE("Temperatures that a line leaves out stay as they were") {
  PrinterView printer;
  printer.hear("ok T:20.5 /210.0 B:21.0 /60.0 @:0");
  printer.hear(" T:30.0 /210.0 @:127");
  CHECK(printer.temperatures.nozzle == 30.0);
  CHECK(printer.temperatures.bed == 21.0);
  CHECK(printer.temperatures.bed_target == 60.0);
}

TEST_CASE("What the print asks of the heaters is known apart from what the user has set since") {
  PrinterView printer;
  CHECK_FALSE(printer.job_nozzle);
  for (const char* line : {"M140 S60", "M190 S60", "M104 S215", "G28"}) printer.run(line);
  printer.expected.run("M104 S230");  // the user's
  CHECK(printer.expected.nozzle == 230);
  CHECK(printer.job_nozzle == 215.0);
  CHECK(printer.job_bed == 60.0);
  printer.run("M109 S205");
  CHECK(printer.job_nozzle == 205.0);
}

TEST_CASE("The text of an action is kept word for word") {
  PrinterView printer;
  CHECK(printer.hear("//action:pause filament_runout").text == "pause filament_runout");
}

TEST_CASE("The nozzle's position is known from the first move until the next homing") {
  PrinterView printer;
  CHECK_FALSE(printer.knows_position());
  printer.expected.run("G1 X10 Y20 Z0.3 F3000");
  CHECK(printer.knows_position());
  printer.expected.run("G28");
  CHECK_FALSE(printer.knows_position());
}
